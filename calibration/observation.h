// The inputs of a calibration: the observations, and the references (landmarks, stars,
// trajectories) that they sight.
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
  kScene,  // a point of the scenery, at an unknown position
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
// As in files, for example "landmark".
const char* name(Kind kind);
std::optional<Kind> kind_of(const std::string& name);

// The data of a rectification target that a person states.
struct TargetFacts {
  // For a level line: a second pixel on the line.
  Eigen::Vector2d second_px = Eigen::Vector2d::Zero();
  double distance_m = 0.0;  // for a cross or a ruler: distance from the pan axis
  // For a cross: its distance to the right of the plane in which the camera tilts. (This plane
  // contains the pan axis and is perpendicular to the tilt axis.) For a ruler: the ruler's reading
  // at the pixel; readings increase upwards. The zeros of all rulers are at the same height.
  double offset_m = 0.0;
  // 1-sigma: of a line's inclination [rad], a cross's position [m], or the height of a ruler's zero
  // [m].
  double sd = 0.0;
};

struct Observation {
  Kind kind = Kind::kLandmark;
  std::size_t station = 0;           // the station's index
  std::optional<std::int64_t> pose;  // sightings of one pose share the errors of its two angles
  std::int64_t utime_us = 0;         // UTC
  UnitReading reading;
  // Whether the directions of approach were stated. If not, both approaches in `reading` are 1.
  bool sides_stated = true;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;     // 1-sigma of each coordinate
  std::string reference;  // the name of the reference; for a scene point, its number
  // For an inclinometer: the inclinations about X and Y of ORIGIN [rad], their 1-sigma, and the
  // 1-sigma of the inclinometer's zero.
  Eigen::Vector2d tilt_rad = Eigen::Vector2d::Zero();
  double tilt_sd_rad = 0.0;
  double zero_sd_rad = 0.0;
  TargetFacts target;
  unsigned line = 0;  // line in the file
};

// A surveyed point.
struct FixedPoint {
  Eigen::Vector3d ecef = Eigen::Vector3d::Zero();  // [m]
  double sd_m = 0.0;                               // 1-sigma of each axis
};

// A star's place: ICRS, at epoch 2000.0.
struct Star {
  double ra_rad = 0.0, dec_rad = 0.0;
  double pm_ra_rad_yr = 0.0;  // proper motion, times the cosine of the declination
  double pm_dec_rad_yr = 0.0;
  double parallax_arcsec = 0.0;
};

// Positions of an aircraft or a drone over time, in ascending order.
struct Trajectory {
  struct Point {
    std::int64_t utime_us = 0;
    Eigen::Vector3d ecef = Eigen::Vector3d::Zero();  // [m]
  };
  std::vector<Point> points;
  double sd_m = 0.0;  // 1-sigma of each axis
};

using Reference = std::variant<FixedPoint, Star, Trajectory>;
using References = std::map<std::string, Reference>;

// Thrown for an observation that cannot be used; holds its index.
class ObservationRefused : public std::invalid_argument {
 public:
  ObservationRefused(std::size_t index, const std::string& key, const std::string& why,
                     std::optional<std::size_t> other = std::nullopt)
      : std::invalid_argument(key + ": " + why), index_(index), other_(other) {}
  std::size_t index() const { return index_; }
  // The index of the observation that the refused one contradicts; nullopt if there is none.
  std::optional<std::size_t> other() const { return other_; }

 private:
  std::size_t index_;
  std::optional<std::size_t> other_;
};

}  // namespace ols::calibration
