#include "calibration/target.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/direction.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kEarthRadius_m = 6371000.0;
constexpr double kScaleHeight_m = 8000.0;  // of the air's density
constexpr double kMicrosecond_s = 1e-6;
constexpr double kNoPrior = std::numeric_limits<double>::infinity();

// The bend of a ray over k s / R: 1/2 along the ground; less towards thin air, whose density falls
// off exponentially: the integral of (1 - u) exp(-u rise / H) over the ray.
double bend(double rise_m) {
  const double a = rise_m / kScaleHeight_m;
  if (std::abs(a) < 1e-3) return 0.5 - a / 6.0;
  return (a - 1.0 + std::exp(-a)) / (a * a);
}

// Terrestrial refraction lifts the point by k s / 2R as seen from GROUND.
void refract(TargetView& view, double k) {
  Vector3d& x = view.point.x;
  const double distance_m = x.norm();
  const Vector3d up = tangent_basis(azimuth_elevation_from_enu(x)).col(1);
  view.by_refraction = distance_m * distance_m / kEarthRadius_m * bend(x.z()) * up;
  x += k * view.by_refraction;
}

// The point in ECEF, seen by the station, without its nuisance.
TargetView place_seen(const State& state, const Sighting& sighting, const Vector3d& ecef) {
  const StationState& station = state.stations[sighting.station];
  TargetView view;
  view.point = {frame_of(station).to_enu(ecef), 1.0};
  refract(view, station.refraction);
  return view;
}

Matrix3d R_enu_ecef(const State& state, const Sighting& sighting) {
  return frame_of(state.stations[sighting.station]).R_ecef_enu().transpose();
}

class Fixed : public Target {
 public:
  explicit Fixed(const FixedPoint& point) : point_(point) {}
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override { return VectorXd::Constant(3, point_.sd_m); }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& off_ecef) const override {
    TargetView view = place_seen(state, sighting, point_.ecef + off_ecef);
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.topRows<3>() = R_enu_ecef(state, sighting);
    return view;
  }

 private:
  FixedPoint point_;
};

class Sky : public Target {
 public:
  explicit Sky(const SkyDirection& direction) : direction_(direction) {}
  TargetView view(const State& state, const Sighting& sighting, const VectorXd&) const override {
    const Matrix3d R = R_enu_ecef(state, sighting);
    TargetView view;
    view.by_air = R * direction_.by_air;
    view.by_ut1 = R * direction_.by_ut1;
    const double air = state.stations[sighting.station].air - 1.0;
    view.point.x = R * direction_.ecef + air * view.by_air + state.ut1_s * view.by_ut1;
    return view;
  }

 private:
  SkyDirection direction_;
};

// The nuisance: along the equator and towards the pole, the same for all sightings.
class Body : public Target {
 public:
  Body(std::vector<SkyPosition> positions, double sd_rad)
      : positions_(std::move(positions)), sd_rad_(sd_rad) {}
  int unknowns() const override { return 2; }
  VectorXd prior_sd() const override { return VectorXd::Constant(2, sd_rad_); }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& off_rad) const override {
    const auto at = std::ranges::find_if(positions_, [&sighting](const SkyPosition& one) {
      return one.station == sighting.station && one.utime_us == sighting.utime_us;
    });
    const Vector3d& ecef = at->direction.ecef;
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = Vector3d::UnitZ().cross(ecef).normalized();
    axes.col(1) = ecef.cross(axes.col(0));
    TargetView view = Sky(at->direction).view(state, sighting, VectorXd(0));
    const Matrix3d R = R_enu_ecef(state, sighting);
    view.point.x += R * axes * off_rad;
    view.by_nuisance.setZero(4, 2);
    view.by_nuisance.topRows<3>() = R * axes;
    return view;
  }

 private:
  std::vector<SkyPosition> positions_;  // of all sightings
  double sd_rad_;
};

// The nuisance: azimuth, elevation and inverse distance [1/m].
class Scene : public Target {
 public:
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override {
    // Nothing of a sweep is much nearer than this.
    constexpr double kNear_m = 50.0;
    return Vector3d(kNoPrior, kNoPrior, 1.0 / kNear_m);
  }
  VectorXd initial(const State& state, const std::vector<Sighting>& sightings) const override {
    const Sighting& first = sightings.front();
    const auto seen =
        predict_direction(state.stations[first.station].model, first.reading, first.pixel);
    if (!seen) return Vector3d::Zero();
    return Vector3d(seen->direction.azimuth_rad, seen->direction.elevation_rad, 0.0);
  }
  TargetView view(const State&, const Sighting&, const VectorXd& nuisance) const override {
    const AzimuthElevation direction{nuisance[0], nuisance[1]};
    const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(direction);
    TargetView view;
    view.moves_with_us = true;
    view.point = {enu_from_azimuth_elevation(direction), nuisance[2]};
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.col(0).head<3>() = tangent.col(0) * std::cos(nuisance[1]);
    view.by_nuisance.col(1).head<3>() = tangent.col(1);
    view.by_nuisance(3, 2) = 1.0;
    return view;
  }
};

class Unknown : public Target {
 public:
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override { return VectorXd::Constant(3, kNoPrior); }
  // Where the lines of sight are nearest to each other.
  VectorXd initial(const State& state, const std::vector<Sighting>& sightings) const override {
    Matrix3d N = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero(), centre = Vector3d::Zero();
    for (const Sighting& one : sightings) centre += origin(state, one);
    centre /= static_cast<double>(sightings.size());
    for (const Sighting& one : sightings) {
      const StationState& station = state.stations[one.station];
      const auto seen = predict_direction(station.model, one.reading, one.pixel);
      if (!seen) continue;
      const Vector3d d =
          frame_of(station).R_ecef_enu() * enu_from_azimuth_elevation(seen->direction);
      const Matrix3d across = Matrix3d::Identity() - d * d.transpose();
      N += across;
      b += across * (origin(state, one) - centre);
    }
    // Lines that are nearly parallel meet at some kilometres rather than anywhere.
    constexpr double kWeak = 1e-9;
    N += kWeak * Matrix3d::Identity();
    return centre + N.inverse() * b;
  }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& ecef) const override {
    TargetView view = place_seen(state, sighting, ecef);
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.topRows<3>() = R_enu_ecef(state, sighting);
    return view;
  }

 private:
  static Vector3d origin(const State& state, const Sighting& one) {
    return frame_of(state.stations[one.station]).origin_ecef();
  }
};

struct Motion {
  Vector3d ecef, velocity_ecef;
};

// On the chord between the two points around the instant; beyond the ends along the last chord.
Motion motion_at(const Trajectory& trajectory, double utime_us) {
  const auto& points = trajectory.points;
  const auto after = std::ranges::find_if(
      points, [utime_us](const auto& p) { return static_cast<double>(p.utime_us) > utime_us; });
  const auto last = points.end() - 1;
  const auto to = std::clamp(after, points.begin() + 1, last);
  const auto from = to - 1;
  const double span_s = kMicrosecond_s * static_cast<double>(to->utime_us - from->utime_us);
  const Vector3d velocity = (to->ecef - from->ecef) / span_s;
  const double since_s = kMicrosecond_s * (utime_us - static_cast<double>(from->utime_us));
  return {from->ecef + since_s * velocity, velocity};
}

class Aircraft : public Target {
 public:
  explicit Aircraft(const Trajectory& trajectory) : trajectory_(trajectory) {}
  int unknowns() const override { return 4; }
  VectorXd prior_sd() const override {
    constexpr double kLatency_s = 1.0;
    const double sd = trajectory_.sd_m;
    return Eigen::Vector4d(sd, sd, sd, kLatency_s);
  }
  // The position of an instant is announced with a later time.
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& nuisance) const override {
    const double utime_us = static_cast<double>(sighting.utime_us) + nuisance[3] / kMicrosecond_s;
    const Motion motion = motion_at(trajectory_, utime_us);
    const Vector3d up = motion.ecef.normalized();
    const Vector3d across = motion.velocity_ecef.cross(up).normalized();
    Matrix3d axes;
    axes << up.cross(across), across, up;
    TargetView view = place_seen(state, sighting, motion.ecef + axes * nuisance.head<3>());
    const Matrix3d R = R_enu_ecef(state, sighting);
    view.by_nuisance.setZero(4, 4);
    view.by_nuisance.topLeftCorner<3, 3>() = R * axes;
    view.by_nuisance.col(3).head<3>() = R * motion.velocity_ecef;
    return view;
  }

 private:
  Trajectory trajectory_;
};

class Drone : public Target {
 public:
  explicit Drone(const Trajectory& trajectory) : trajectory_(trajectory) {}
  int unknowns() const override { return 3; }
  VectorXd prior_sd() const override {
    constexpr double kAntenna_m = 0.1;
    return VectorXd::Constant(3, kAntenna_m);
  }
  TargetView view(const State& state, const Sighting& sighting,
                  const VectorXd& offset_ecef) const override {
    const Motion motion = motion_at(trajectory_, static_cast<double>(sighting.utime_us));
    TargetView view = place_seen(state, sighting, motion.ecef + offset_ecef);
    view.by_nuisance.setZero(4, 3);
    view.by_nuisance.topRows<3>() = R_enu_ecef(state, sighting);
    view.white_sd_m = trajectory_.sd_m;
    return view;
  }

 private:
  Trajectory trajectory_;
};

class OtherStation : public Target {
 public:
  explicit OtherStation(std::size_t station) : station_(station) {}
  std::optional<std::size_t> on_station() const override { return station_; }
  TargetView view(const State& state, const Sighting& sighting, const VectorXd&) const override {
    const StationModel& other = state.stations[station_].model;
    const LocalFrame there = frame_of(state.stations[station_]);
    const auto poses = joints(other.geometry.chain, {});
    const Vector3d axes = poses[static_cast<std::size_t>(Joint::kAzi)].translation();
    TargetView view = place_seen(state, sighting, there.to_ecef(axes));
    view.by_position = R_enu_ecef(state, sighting) * there.R_ecef_enu();
    return view;
  }

 private:
  std::size_t station_;
};

}  // namespace

TargetPtr fixed_target(const FixedPoint& point) { return std::make_shared<Fixed>(point); }
TargetPtr sky_target(const SkyDirection& direction) { return std::make_shared<Sky>(direction); }
TargetPtr body_target(std::vector<SkyPosition> positions, double sd_rad) {
  return std::make_shared<Body>(std::move(positions), sd_rad);
}
TargetPtr scene_target() { return std::make_shared<Scene>(); }
TargetPtr unknown_target() { return std::make_shared<Unknown>(); }
TargetPtr aircraft_target(const Trajectory& trajectory) {
  return std::make_shared<Aircraft>(trajectory);
}
TargetPtr drone_target(const Trajectory& trajectory) { return std::make_shared<Drone>(trajectory); }
TargetPtr station_target(std::size_t station) { return std::make_shared<OtherStation>(station); }

}  // namespace ols::calibration
