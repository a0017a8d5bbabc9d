// The probes' results as plain values, from which the judge_ functions make findings. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/clock/clock_watch.h"
#include "edge/device/device_report.h"
#include "edge/ptu/unit_model.h"

namespace ols::doctor {

// The content of a station's status message.
struct StationFacts {
  std::string id;
  std::string state;  // "tracking"
  std::vector<device::DeviceReport> devices;
  clock::ClockState clock = clock::ClockState::kUnknown;
  double clock_error_s = 0.0;
  bool position_known = true;
  struct Calibration {
    bool in_use = false, doubted = false;
    double sd_rad = 0.0;  // 1-sigma of a direction, each axis
    double age_s = 0.0;   // time since the calibration's last observation; 0: not stated
  } calibration;
  std::vector<Alarm> alarms;
  std::map<std::string, double> counters;
  std::string last_error;
  double last_error_age_s = 0.0;
  std::size_t boots = 1;  // number of processes that use this id
  std::string text;       // the whole status, for a person
};

struct BusFacts {
  std::string url;
  std::string trouble;        // why the bus does not work; empty: it works
  std::string interface;      // interface by which messages leave this host; empty: unknown
  int ttl = 0;                // 0: messages stay on this host
  std::int64_t rmem_max = 0;  // net.core.rmem_max [byte]; 0: unknown
  std::map<std::string, StationFacts> stations;
  int fusions = 0;
  std::vector<Alarm> fusion_alarms;
  // Whether signatures are checked: unsigned messages are ignored, or at least counted.
  bool is_verified = false;
  Alarm trust_trouble{};  // what is wrong with keys or trust list; empty: nothing
  std::map<std::string, double> distrusted;  // number of messages that failed verification while
                                             // the doctor listened, by "bus_distrusted_<reason>"
};

struct SerialFacts {
  std::string device;
  int error = 0;  // errno of opening the line; 0: it can be opened
  // Other processes that have opened the line: "ols-station (1234)".
  std::vector<std::string> users;
};

struct PtuAxisAnswers {
  std::optional<double> resolution_arcsec;
  std::optional<double> least, greatest;  // [counts]
};

struct PtuAnswers {
  SerialFacts serial;
  int baud = 0;  // the rate at which the unit answered; 0: no answer
  int wanted_baud = 0, wanted_line_baud = 0;
  std::string version;
  PtuAxisAnswers pan, tilt;
  bool not_referenced = false;
  std::optional<ptu::PtuEnvironment> environment;
  double supply_min_V = 0.0;
};

// A network interface.
struct LinkFacts {
  std::string name;  // empty: no route
  bool carrier = false;
  int mtu = 0;
  std::optional<int> speed_Mbit_s;
  std::uint64_t received = 0, dropped = 0;  // packets since the interface came up
};

struct CameraAnswers {
  std::string device;
  std::string trouble;  // why the camera cannot be used; empty: it can be used
  std::string identity;
  bool controlled = false;  // whether another program controls the camera
  // False: Aravis stamps frames with the host's time instead of the camera's.
  bool has_clock = true;
  std::optional<double> temperature_degC;
  std::vector<std::string> others;  // other cameras that answered a broadcast
  std::optional<LinkFacts> link;
  double rate_bytes_s = 0.0;  // of the configured stream
};

struct FolderFacts {
  std::string name;  // the folder's purpose
  std::string folder;
  int error = 0;  // errno of the examination of the folder or of its write access; 0: none
  double free_bytes = 0.0, reserve_bytes = 0.0;
};

// A systemd unit, from the output of `systemctl show`.
struct UnitFacts {
  std::string id, load, active, sub, result, status;
  int restarts = 0;
};

}  // namespace ols::doctor
