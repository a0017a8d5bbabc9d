// The conditions under which a calibration may begin, and warnings for the person. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"

namespace ols::calibration {

// The largest allowed clock error when the sky or drones are sighted: in a second, a star moves by
// 15 arc seconds, and a drone at 10 m/s by 10 m.
inline constexpr double kClockOfSky_s = 0.05;

// The facts from a station's status that the check needs.
struct StationFacts {
  bool camera_works = false, unit_works = false;
  bool moves = true;          // false for a fixed mount
  bool limits_known = false;  // the unit is homed and has reported its travel
  bool stopped = false, emergency = false;
  bool held_by_hand = false;  // an operator controls the unit manually
  bool follows_target = false;
  double status_gap_s = 0.0;  // time between two statuses
  bool has_position = false, has_tilt = false;
  double position_sd_m = 0.0, tilt_sd_deg = 0.0, heading_sd_deg = 0.0;  // 1-sigma
  bool clock_synchronised = false;
  double clock_error_s = 0.0;
  int image_width_px = 0, image_height_px = 0;
  std::vector<Alarm> alarms;
};

struct Wanted {
  // Largest time between two statuses. With a longer one, the procedure would notice a stop of the
  // station too late.
  double status_gap_s = 0.0;
  bool absolute_time = false;  // the clock must be right: for stars, the sun, aircraft and drones
  bool sun_kept_out = false;   // the sun is up and must stay out of the picture
  int image_width_px = 0, image_height_px = 0;  // as configured
};

struct Precondition {
  bool met = false;
  bool needed = true;    // false if it is only a warning
  std::string sentence;  // for a person: the present state, and what to do about it
};

// The conditions, in the order in which a person should meet them.
std::vector<Precondition> preconditions(const StationFacts& facts, const Wanted& wanted);
// The first needed condition that is not met, as a sentence; empty if the calibration can begin.
std::string first_hindrance(const std::vector<Precondition>& all);

}  // namespace ols::calibration
