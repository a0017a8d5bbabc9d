// The operator's side of the bus: sends a command to a station and reads the outcome from its
// status.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "base/lcm_bus.h"
#include "ols_msg/designate_t.hpp"
#include "ols_msg/ptu_command_t.hpp"
#include "ols_msg/record_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "tools/ctl/heard_status.h"

namespace ols::ctl {

class Operator {
 public:
  using Statuses = std::map<std::string, ols_msg::station_status_t>;

  // `station` or "all". Throws BusError.
  Operator(const std::string& lcm_url, std::string station);

  // Listens and returns the newest status of each addressed station. One named station: until its
  // status arrives, at most timeout_s; all: for two status intervals.
  const Statuses& listen(double timeout_s);
  // The table of stations is full: forged statuses may hide real stations.
  bool is_full() const { return statuses_.size() >= kMostStationsHeard; }

  // Sends stops repeatedly to the addressed station, or to each as soon as it is heard, until its
  // status confirms one or timeout_s is over: a stop needs no status, and may get lost. Returns
  // whether each station confirmed.
  std::map<std::string, bool> stop(double timeout_s);

  // Each sends the command and waits for the status that counts it. Returns nothing if it was
  // accepted, otherwise the station's reason.
  std::optional<std::string> designate(const std::string& station, double x, double y, double width,
                                       double height);
  std::optional<std::string> point(const std::string& station, double pan_rad, double tilt_rad);
  std::optional<std::string> release(const std::string& station);
  std::optional<std::string> rearm(const std::string& station);
  // Reports acceptance only: homing takes half a minute; the status shows its result.
  std::optional<std::string> home(const std::string& station);
  std::optional<std::string> reference_ok(const std::string& station);
  // The raw frames around now.
  std::optional<std::string> record(const std::string& station, double before_s, double after_s,
                                    const std::string& label);

 private:
  void hear(const BusMessage& message);
  bool says_stopped(const std::string& station, double stops_before) const;
  template <class Message>
  void address(Message& message, const std::string& station);
  void publish_ptu(const std::string& station, std::int8_t command, double pan_rad,
                   double tilt_rad);
  std::optional<std::string> send_ptu(const std::string& station, std::int8_t command,
                                      double pan_rad, double tilt_rad, const std::string& counter);
  std::optional<std::string> outcome(const std::string& station, const std::string& counter);

  std::string station_;
  LcmBus bus_;
  Statuses statuses_;
  std::int64_t boot_id_;
  std::int64_t sequence_ = 0;
  bool stopping_ = false;  // every station that is heard
};

// The value of a counter in a status; 0 if it is missing.
double counter(const ols_msg::station_status_t& status, const std::string& name);

const char* state_name(std::int8_t state);
const char* device_name(std::int8_t device);
// The state of a device by its name; "-" when the station has no such device.
const char* device_state(const ols_msg::station_status_t& status, const std::string& name);

}  // namespace ols::ctl
