// The settings that a station reads from its configuration file (docs/configuration.md).
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

// Serial numbers of the parts of the instrument; each is empty if not stated.
struct InstrumentSerials {
  std::string camera, lens, ptu;
};

// The site's settings, as far as this station uses them.
struct SiteChoice {
  std::string file;         // the station's own configuration file; empty if none was read
  std::int64_t number = 0;  // number of the site's settings in use; 0 if there are none
  // Keys of the site's settings that the station's own file overrides.
  std::vector<std::string> own;
};

struct StationSettings {
  // Name of the station: letters, digits, - and _. At most 32 characters, because it is part of
  // channel names.
  std::string id;
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string state_folder;  // folder for the persisted state; if empty, nothing is persisted
  std::int64_t calibration_id = 0;
  // Idle time after which the station checks its reference views again; 0 for no checks.
  double view_check_s = 600.0;
  // Folder written by `ols-calibrate adjust`; empty if there is none.
  std::string calibration_folder;
  // Folder written by `ols-land import`; empty if no land is known.
  std::string land_folder;
  InstrumentSerials serials;
  std::uint64_t tracker_seed = 1;
  double status_interval_s = 0.5;
  double preview_interval_s = 1.0;  // 0 for no previews
  StationConfig station;
  sensors::PoseEstimator::Config pose;
  ChosenCamera camera{camera_kinds()};
  bool keep_raw = false;  // also keep the camera's raw images, for recorder and tracker
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
  std::string software;  // version of this program, for the status message
};

config::Section station_section(StationSettings& settings);  // describes the whole file
// Throws ConfigError; its message is "file:line: key: what is wrong".
StationSettings load_station_settings(const std::string& path);
// As above; the site's settings are the defaults for keys that are missing in the file.
StationSettings load_station_settings(const std::string& path, const trust::SiteSettings& site);
// The section [station] of a site's settings: those keys of a station's file that a site may set
// for all of its stations.
config::Section site_section(StationSettings& settings);

// Returns a function that checks whether the station whose configuration file is `path` can use a
// site's settings.
trust::SettingsCheck site_check(const std::string& path);

// The lines that --check-config prints: a summary of the settings, one line per subject.
std::vector<std::string> describe(const StationSettings& settings);

}  // namespace ols::station
