// A target: the object that a pixel shows. Computes where a station should see the target, and how
// this depends on the unknowns of an adjustment. The unknowns of the target itself are its nuisance
// parameters ("the nuisance").
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "calibration/observation.h"
#include "calibration/state.h"
#include "geometry/pixel_prediction.h"

namespace ols::calibration {

// One sighting of a target.
struct Sighting {
  std::size_t station = 0;
  std::int64_t utime_us = 0;
  UnitReading reading;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
  // The index of a shared pose; nullopt if the sighting has its own pose.
  std::optional<std::size_t> pose;
  double pose_sd_rad = 0.0;  // 1-sigma of each angle, if the sighting has its own pose
};

struct TargetView {
  HomogeneousPoint point;  // in GROUND of the station that sees it
  // Derivatives: of x and w with respect to the target's nuisance; of x with respect to the
  // station's refraction, its air, and UT1.
  Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 4> by_nuisance =
      Eigen::Matrix<double, 4, Eigen::Dynamic, 0, 4, 4>::Zero(4, 0);
  Eigen::Vector3d by_refraction = Eigen::Vector3d::Zero();
  Eigen::Vector3d by_air = Eigen::Vector3d::Zero();
  Eigen::Vector3d by_ut1 = Eigen::Vector3d::Zero();
  // If the target is another station: derivative of x with respect to that station's east, north
  // and up.
  Eigen::Matrix3d by_position = Eigen::Matrix3d::Zero();
  double white_sd_m = 0.0;     // 1-sigma of the position; independent at every sighting
  bool moves_with_us = false;  // the target's position is stated in the station's own frame
};

inline constexpr double kNoPrior = std::numeric_limits<double>::infinity();

class Target {
 public:
  virtual ~Target() = default;
  virtual int unknowns() const { return 0; }
  // 1-sigma of each nuisance parameter; kNoPrior if it has no prior.
  virtual Eigen::VectorXd prior_sd() const { return Eigen::VectorXd(0); }
  // The nuisance with which an adjustment begins.
  virtual Eigen::VectorXd initial(const State&, const std::vector<Sighting>&) const {
    return Eigen::VectorXd::Zero(unknowns());
  }
  virtual std::optional<std::size_t> on_station() const { return std::nullopt; }
  virtual TargetView view(const State& state, const Sighting& sighting,
                          const Eigen::VectorXd& nuisance) const = 0;
};
using TargetPtr = std::shared_ptr<const Target>;

// A surveyed point. The nuisance: the constant errors of its three coordinates.
TargetPtr fixed_target(const FixedPoint& point);
// The direction of a celestial body at one instant, in ECEF, including astronomical refraction.
struct SkyDirection {
  Eigen::Vector3d ecef = Eigen::Vector3d::UnitX();  // unit vector, apparent
  // Derivative with respect to the factor of the refraction.
  Eigen::Vector3d by_air = Eigen::Vector3d::Zero();
  Eigen::Vector3d by_ut1 = Eigen::Vector3d::Zero();  // [1/s] derivative with respect to UT1
  double elevation_rad = 0.0;                        // apparent
};
// A celestial body that is sighted once.
TargetPtr sky_target(const SkyDirection& direction);
// A celestial body whose computed directions have the same error at all instants. sd_rad: 1-sigma
// of this error, each axis.
struct SkyPosition {
  std::size_t station = 0;
  std::int64_t utime_us = 0;
  SkyDirection direction;
};
TargetPtr body_target(std::vector<SkyPosition> positions, double sd_rad);
// A point of the scenery. The nuisance: its direction and its inverse distance from GROUND.
TargetPtr scene_target();
// A target at an unknown position. The nuisance: the position.
TargetPtr unknown_target();
// An aircraft that broadcasts its position. The nuisance: the constant errors of its positions
// (along its path, across it, up), and the latency of the broadcast.
TargetPtr aircraft_target(const Trajectory& trajectory);
// A drone. The nuisance: the offset of its visible centre from the antenna (east, north, up).
TargetPtr drone_target(const Trajectory& trajectory);
// Another station. The sighted point is the intersection of that station's axes.
TargetPtr station_target(std::size_t station);

}  // namespace ols::calibration
