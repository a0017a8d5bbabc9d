// What was observed, and what it refers to: the inputs of a calibration.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "geometry/station_model.h"

namespace ols::calibration {

enum class Kind {
  kLandmark,
  kStar,
  kSun,
  kScene,  // a point of the scenery, wherever it is
  kStation,
  kAircraft,
  kDrone,
  kTrack,  // an unknown target that several stations see at the same instants
  kInclinometer,
  // The paper's rectification targets (section 4.2).
  kLevelLine,
  kCross,
  kRuler,
};
inline bool is_rectification_target(Kind kind) {
  return kind == Kind::kLevelLine || kind == Kind::kCross || kind == Kind::kRuler;
}
// As in the files: "landmark".
const char* name(Kind kind);
std::optional<Kind> kind_of(const std::string& name);

// What a person states of a rectification target.
struct TargetFacts {
  Eigen::Vector2d second_px = Eigen::Vector2d::Zero();  // of a level line: another pixel of it
  double distance_m = 0.0;                              // from the pan axis; of a cross, a ruler
  // Of a cross: to the right of the plane that is square to the tilt axis and contains the pan
  // axis. Of a ruler: the reading at the pixel, growing upwards; all have their zeros level.
  double offset_m = 0.0;
  double sd = 0.0;  // of a line's level [rad]; of a cross's place, of a ruler's zero [m]
};

struct Observation {
  Kind kind = Kind::kLandmark;
  std::size_t station = 0;           // index
  std::optional<std::int64_t> pose;  // sightings of one pose share the errors of its two angles
  std::int64_t utime_us = 0;         // UTC
  UnitReading reading;
  bool sides_stated = true;  // whether the approach of both angles was; else it is taken as 1
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;     // of each coordinate
  std::string reference;  // a name; of a scene point its number
  // An inclinometer's: inclination about X and Y of ORIGIN [rad], and how well its zero is known.
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();
  double tilt_sd_rad = 0.0;
  double zero_sd_rad = 0.0;
  TargetFacts target;
  unsigned line = 0;  // of the file
};

// A surveyed point.
struct FixedPoint {
  Eigen::Vector3d ecef = Eigen::Vector3d::Zero();  // [m]
  double sd_m = 0.0;                               // of each axis
};

// ICRS, at 2000.0.
struct Star {
  double ra_rad = 0.0, dec_rad = 0.0;
  double pm_ra_rad_yr = 0.0;  // times the cosine of the declination, as catalogues have it
  double pm_dec_rad_yr = 0.0;
  double parallax_arcsec = 0.0;
};

// Positions in time of an aircraft or a drone; the instants grow.
struct Trajectory {
  struct Point {
    std::int64_t utime_us = 0;
    Eigen::Vector3d ecef = Eigen::Vector3d::Zero();  // [m]
  };
  std::vector<Point> points;
  double sd_m = 0.0;  // of each axis
};

using Reference = std::variant<FixedPoint, Star, Trajectory>;
using References = std::map<std::string, Reference>;

// An observation that cannot be used: by its index among all of them.
class ObservationRefused : public std::invalid_argument {
 public:
  ObservationRefused(std::size_t index, const std::string& key, const std::string& why,
                     std::optional<std::size_t> other = std::nullopt)
      : std::invalid_argument(key + ": " + why), index_(index), other_(other) {}
  std::size_t index() const { return index_; }
  // With which it is at odds.
  std::optional<std::size_t> other() const { return other_; }

 private:
  std::size_t index_;
  std::optional<std::size_t> other_;
};

}  // namespace ols::calibration
