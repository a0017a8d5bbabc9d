// The conditions under which a calibration may begin, and warnings for the person. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"

namespace ols::calibration {

// The largest error of a clock by which the sky and drones are sighted: a second is 15 arc seconds
// of a star, and a drone at 10 m/s flies 10 m.
inline constexpr double kClockOfSky_s = 0.05;

// What the check needs to know from a station's status.
struct StationFacts {
  bool camera_works = false, unit_works = false;
  bool moves = true;          // false for a fixed mount
  bool limits_known = false;  // the unit is homed and has reported its travel
  bool stopped = false, emergency = false;
  bool held_by_hand = false;  // an operator controls the unit manually
  bool follows_target = false;
  double status_gap_s = 0.0;  // interval between two statuses
  bool has_position = false, has_tilt = false;
  double position_sd_m = 0.0, tilt_sd_deg = 0.0, heading_sd_deg = 0.0;  // 1-sigma
  bool clock_synchronised = false;
  double clock_error_s = 0.0;
  int image_width_px = 0, image_height_px = 0;
  std::vector<Alarm> alarms;
};

struct Wanted {
  // Largest interval between statuses that still lets a stop be noticed in time.
  double status_gap_s = 0.0;
  bool absolute_time = false;                   // needed for stars, the sun, aircraft and drones
  bool sun_kept_out = false;                    // the sun is up, and must stay out of the picture
  int image_width_px = 0, image_height_px = 0;  // as configured
};

struct Precondition {
  bool met = false;
  bool needed = true;    // false if it is only a warning
  std::string sentence;  // for a person: the state, and what to do about it
};

// The conditions, in the order in which a person should meet them.
std::vector<Precondition> preconditions(const StationFacts& facts, const Wanted& wanted);
// The first needed condition that is not met, as a sentence; empty if the calibration can begin.
std::string first_hindrance(const std::vector<Precondition>& all);

}  // namespace ols::calibration
