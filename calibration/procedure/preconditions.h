// What must be so before a calibration begins, and what a person should at least know. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ols::calibration {

// How a station's alarm begins that a device says another serial number than is configured.
inline constexpr const char* kAnotherDevice = "calibration: another ";

// Of a station's status.
struct StationFacts {
  bool camera_works = false, unit_works = false;
  bool limits_known = false;  // the unit is homed and has said its travel
  bool stopped = false, emergency = false;
  bool held_by_hand = false;  // under manual operation, whoever has taken it
  bool follows_target = false;
  double status_gap_s = 0.0;  // between two statuses
  bool has_position = false, has_tilt = false;
  double position_sd_m = 0.0, tilt_sd_deg = 0.0, heading_sd_deg = 0.0;  // 1-sigma
  bool clock_synchronised = false;
  double clock_error_s = 0.0;
  int image_width_px = 0, image_height_px = 0;
  std::vector<std::string> alarms;
};

struct Wanted {
  double status_gap_s = 0.0;                    // less than this: a stop is heard of in time
  bool absolute_time = false;                   // stars, the sun, aircraft, drones
  bool sun_kept_out = false;                    // it is up, and must not come into the picture
  int image_width_px = 0, image_height_px = 0;  // by the configuration
};

struct Precondition {
  bool met = false;
  bool needed = true;    // else it is only said
  std::string sentence;  // for a person: what is, and what to do
};

// In the order in which a person puts them right.
std::vector<Precondition> preconditions(const StationFacts& facts, const Wanted& wanted);
// Why a calibration cannot begin; empty: it can.
std::string first_hindrance(const std::vector<Precondition>& all);

}  // namespace ols::calibration
