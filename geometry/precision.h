// How accurately N stations can determine a position: the Cramer-Rao bound for one instant. It can
// be computed before any measurement. The Earth's curvature is included: each station has its own
// horizon, and distances are unlimited.
//
// Each station measures the direction to the target on its tangent plane (geometry/direction.h).
// Its errors are independent of those of other stations. Errors of a station that are constant from
// frame to frame are nuisance parameters with known deviations. When they are marginalised, the
// information about the position is the sum over stations of H' R^-1 H. H is the derivative of the
// station's direction with respect to the position, and R is the covariance of all errors of the
// station. The inverse of the information is the bound. (H. Van Trees, Detection, Estimation, and
// Modulation Theory I, section 2.4.3: the bound with random nuisance parameters, for the linear
// Gaussian case.)
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <span>

#include "geometry/sight.h"
#include "geometry/wgs84.h"

namespace ols {

// 2x3 [rad/m]: derivative of the direction to a point with respect to the point's ECEF position.
// The direction is given on its tangent plane (cross-elevation, elevation), relative to the
// station's horizon. With its sign reversed, it is the derivative with respect to the station's own
// position; this neglects that the horizon rotates with the station's position (below 2e-7 rad/m
// outside the polar regions).
Eigen::Matrix<double, 2, 3> bearing_jacobian(const LocalFrame& station,
                                             const Eigen::Vector3d& p_ecef);

// One station's measurement of one target.
struct BearingPrecision {
  LocalFrame station{Geodetic{}};  // origin: the camera centre
  Eigen::Matrix2d covariance_rad2 =
      Eigen::Matrix2d::Zero();  // of all errors together, (cross-elevation, elevation)
};

// H' R^-1 H of one station [1/m^2], ECEF components. R must be positive definite.
Eigen::Matrix3d bearing_information(const BearingPrecision& bearing, const Eigen::Vector3d& p_ecef);

// The inverse of an information matrix. nullopt if a direction is not determined (its share of the
// information is below 1e-12).
std::optional<Eigen::Matrix3d> bound_from_information(const Eigen::Matrix3d& information);

// The bound [m^2] of a target at p_ecef, in ECEF components. nullopt if the stations do not
// determine the position (there are fewer than two, or all are on one line with the target).
std::optional<Eigen::Matrix3d> cramer_rao_bound(std::span<const BearingPrecision> bearings,
                                                const Eigen::Vector3d& p_ecef);

// A planned station with its optical axis on the target.
struct PlannedStation {
  LocalFrame place{Geodetic{}};  // origin: the camera centre
  double white_rad = 0.0;  // 1-sigma of each axis of the tangent plane; independent in every frame
  // Constant errors. mount_roll_rad has no effect here, because a roll about the optical axis does
  // not move this axis.
  CalibrationSd calibration;
  double clock_sd_s = 0.0;  // 1-sigma, constant; the target moves during this time
  // Whether a point [m, ECEF] is in sight of the station. If empty, the land hides nothing.
  std::function<bool(const Eigen::Vector3d& p_ecef)> sees = {};

  bool in_sight(const Eigen::Vector3d& p_ecef) const { return !sees || sees(p_ecef); }
};

// The sources of a direction's error.
enum class ErrorSource { kWhite, kHeading, kTilt, kMounting, kPosition, kClock };
inline constexpr std::array kErrorSources{ErrorSource::kWhite,    ErrorSource::kHeading,
                                          ErrorSource::kTilt,     ErrorSource::kMounting,
                                          ErrorSource::kPosition, ErrorSource::kClock};

// A planned target, with its motion.
struct PlannedTarget {
  Eigen::Vector3d p_ecef = Eigen::Vector3d::Zero();  // [m]
  // [m^2/s^2] second moment E[v v'] of the target's velocity, ECEF. For a known velocity: v v'. For
  // a known speed in any direction: speed^2 / 3 times the identity.
  Eigen::Matrix3d velocity_moment_ecef = Eigen::Matrix3d::Zero();
};

// The covariance [rad^2] of a station's direction on the tangent plane that one source causes. The
// variance of white errors is divided by the number of independent exposures.
Eigen::Matrix2d source_covariance(const PlannedStation& station, ErrorSource source,
                                  const PlannedTarget& target, double exposures = 1.0);

// The sum over all sources.
BearingPrecision bearing_precision(const PlannedStation& station, const PlannedTarget& target,
                                   double exposures = 1.0);

struct PositionPrecision {
  Eigen::Matrix3d covariance_ecef = Eigen::Matrix3d::Zero();  // [m^2] the bound
  // [m^2] the contribution of each source, in the order of kErrorSources. They sum to the bound.
  std::array<Eigen::Matrix3d, kErrorSources.size()> parts_ecef{};
};

// Uses the stations that see the target. nullopt if they do not determine its position.
std::optional<PositionPrecision> position_precision(std::span<const PlannedStation> stations,
                                                    const PlannedTarget& target,
                                                    double exposures = 1.0);

}  // namespace ols
