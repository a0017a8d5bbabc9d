// Everything that a station's configuration file holds. docs/operations.md explains each key.
#pragma once

#include <cstdint>
#include <string>

#include "edge/camera/camera_config.h"
#include "edge/command_gate.h"
#include "edge/ptu/ptu_config.h"
#include "edge/station.h"
#include "edge/tracker/tracker_config.h"

namespace ols {

struct StationSettings {
  std::string id;  // letters, digits, - and _; at most 32, because it is part of the channel names
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::int64_t calibration_id = 0;
  double clock_sd_s = 1e-3;  // 1-sigma of this computer's UTC, until it is measured
  std::uint64_t tracker_seed = 1;
  double status_interval_s = 0.5;
  double preview_interval_s = 1.0;  // 0: none
  StationConfig station;
  CameraConfig camera;
  PtuConfig ptu;
  TrackerConfig tracker;
  CommandGate::Config gate;
};

// Throws ConfigError ("file:line: key: what").
StationSettings load_station_settings(const std::string& path);

}  // namespace ols
