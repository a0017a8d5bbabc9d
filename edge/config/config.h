// The contents of a station's configuration file: docs/configuration.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/trust/site_settings.h"
#include "base/trust/trust_config.h"
#include "edge/clock/clock_watch.h"
#include "edge/command/command_gate.h"
#include "edge/config/device_kinds.h"
#include "edge/gpio/gpio_config.h"
#include "edge/lens/lens_config.h"
#include "edge/process/host_monitor.h"
#include "edge/recorder/recorder.h"
#include "edge/sensors/pose_estimator.h"
#include "edge/station/station.h"
#include "edge/tracker/tracker_config.h"
#include "edge/video/video_server.h"

namespace ols::config {
struct Section;
}
namespace ols::station {

// Serial numbers of the parts of an instrument; empty: not stated.
struct InstrumentSerials {
  std::string camera, lens, ptu;
};

// A station's share of its site's settings.
struct SiteChoice {
  std::string file;              // the station's own configuration; empty: none was read
  std::int64_t number = 0;       // of the settings in use; 0: none
  std::vector<std::string> own;  // the site's keys to which the station's file gives other values
};

struct StationSettings {
  std::string id;  // letters, digits, - and _; at most 32, because it is part of the channel names
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string state_folder;  // of the persisted state; empty: nothing is persisted
  std::int64_t calibration_id = 0;
  double view_check_s = 600.0;     // idle time between two checks of the reference views; 0: none
  std::string calibration_folder;  // of `ols-calibrate adjust`; empty: none
  InstrumentSerials serials;
  std::uint64_t tracker_seed = 1;
  double status_interval_s = 0.5;
  double preview_interval_s = 1.0;  // 0: none
  StationConfig station;
  sensors::PoseEstimator::Config pose;
  ChosenCamera camera{camera_kinds()};
  bool keep_raw = false;  // the camera's raw images, too
  ChosenMount mount{mount_kinds()};
  lens::LensMotorConfig lens;
  ChosenInclinometer inclinometer{inclinometer_kinds()};
  ChosenGnss gnss{gnss_kinds()};
  gpio::GpioConfig gpio;
  recorder::RecorderConfig recorder;
  video::VideoConfig video;
  clock::ClockWatch::Config clock;
  HostConfig host;
  tracker::TrackerConfig tracker;
  CommandGate::Config gate;
  trust::TrustConfig trust;
  SiteChoice site;
  std::string software;  // version of this program, for the status
};

config::Section station_section(StationSettings& settings);  // the whole file
// Throws ConfigError ("file:line: key: what").
StationSettings load_station_settings(const std::string& path);
// The same, with the site's settings as defaults for keys that are missing in the file.
StationSettings load_station_settings(const std::string& path, const trust::SiteSettings& site);
// The keys of [station] in a site's settings: those that are the same on all stations.
config::Section site_section(StationSettings& settings);

// Checks whether the station with this configuration file can use the site's settings.
trust::SettingsCheck site_check(const std::string& path);

// The configuration for --check-config, one line per subject.
std::vector<std::string> describe(const StationSettings& settings);

}  // namespace ols::station
