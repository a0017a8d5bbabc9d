// Records for export, independent of the format. Angles are in degrees, as in every format. Heights
// are above the WGS84 ellipsoid; each place also has the geoid's height, for formats with heights
// above sea level.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "wire/object_class.h"

namespace ols::exports {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Place {
  double latitude_deg = 0.0;   // WGS84
  double longitude_deg = 0.0;  // WGS84
  double height_m = 0.0;       // above the ellipsoid
  double geoid_m = kUnknown;   // the geoid's height above the ellipsoid at this place

  double above_sea_m() const { return height_m - geoid_m; }
};

// A symmetric matrix in east, north, up at the place: ee, en, eu, nn, nu, uu.
using Covariance = std::array<double, 6>;

using wire::ObjectClass;
// The values are those of target_t's TRACK_*.
enum class TrackState { kTentative, kConfirmed, kCoasted, kEnded };

struct Target {
  std::int64_t utime_us = 0;
  std::string uid;      // the same in all formats; identity.h
  std::int64_t id = 0;  // the fusion's number
  TrackState state = TrackState::kConfirmed;
  Place place;  // the last place, if the target has ended
  Covariance covariance_m2{};
  std::array<double, 3> velocity_enu_m_s{};  // unknown if not estimated
  Covariance velocity_covariance_m2_s2{};
  std::vector<std::string> stations;  // stations whose bearings are used
  ObjectClass object_class = ObjectClass::kUnknown;
  double class_probability = kUnknown;             // probability of object_class, 0..1
  double size_m = kUnknown, size_sd_m = kUnknown;  // largest extent, and its 1-sigma
  // height above the ground, and its 1-sigma
  double above_ground_m = kUnknown, above_ground_sd_m = kUnknown;
};

// The words for station_status_t's STATE_*, in the order of their values; the last is for an
// unknown value.
inline constexpr std::array kStationStates{"idle",   "manual",  "tracking",  "coasting", "lost",
                                           "slewed", "stopped", "emergency", "hidden",   "unknown"};

struct Station {
  std::int64_t utime_us = 0;
  std::string uid;
  std::string name;
  Place place;
  std::array<double, 3> position_sd_m{};      // east, north, up
  double azimuth_deg = kUnknown;              // of the optical axis; clockwise from true north
  double elevation_deg = kUnknown;            // above the horizon
  std::array<double, 2> field_of_view_deg{};  // horizontal, vertical; 0: unknown
  std::string state;                          // one of kStationStates
  bool is_well = true;                        // whether it has no alarm
  bool clock_is_good = true;
  std::size_t alarms = 0;
};

// The line of sight on which a station sees the object that it follows.
struct Line {
  std::int64_t utime_us = 0;  // at mid-exposure
  std::string uid;
  std::string station;
  Place camera;
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
  // 1-sigma across the line of sight, horizontally: the azimuth's 1-sigma times the cosine of the
  // elevation.
  double cross_sd_deg = 0.0;
  double elevation_sd_deg = 0.0;
  double belief = 1.0;        // 0..1
  std::int64_t track_id = 0;  // a new, greater number with each designation
};

// A target in an area that is watched.
struct Incident {
  std::int64_t utime_us = 0;
  std::string uid;
  std::int64_t number = 0;  // given by the console that watches the area
  std::string area;
  std::int64_t target_id = 0;
  std::string target_uid;
  std::string object_class;             // a name of wire/object_class.h, such as "drone"
  double class_probability = kUnknown;  // probability of object_class, 0..1
  std::int64_t begun_us = 0;
  std::int64_t ended_us = 0;          // 0: the target is still inside
  Place place;                        // the target's last place inside the area
  std::string verdict, judged_by;     // "open", "confirmed" or "dismissed", and who said so
  std::vector<std::string> stations;  // stations that saw the target

  bool is_inside() const { return ended_us == 0; }
  bool is_alarm() const { return is_inside() && verdict != "dismissed"; }
};

}  // namespace ols::exports
