#include "calibration/rectification_block.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "geometry/angles.h"
#include "geometry/direction.h"

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kSquare_rad = 0.09;  // a board that is put up by eye: 5 degrees
constexpr double kTape_m = 0.02;      // of a distance

using ByParameters = Eigen::Matrix<double, 3, kModelParameters>;

// The ray of a pixel, of unit length, and what turns it.
struct Ray {
  Vector3d direction = Vector3d::UnitX();  // east-north-up
  ByParameters by_parameters = ByParameters::Zero();
  Eigen::Matrix<double, 3, 2> by_shafts = Eigen::Matrix<double, 3, 2>::Zero();
};

std::optional<Ray> ray_of(const StationModel& model, const UnitReading& reading,
                          const Vector2d& pixel) {
  const auto seen = predict_direction(model, reading, pixel);
  if (!seen) return std::nullopt;
  Ray ray;
  ray.direction = enu_from_azimuth_elevation(seen->direction);
  const auto image = predict_pixel(model, reading, {ray.direction, 0.0});
  if (!image) return std::nullopt;
  const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(seen->direction);
  const Eigen::Matrix2d by_tangent = image->by_x * tangent;
  ray.by_parameters = tangent * seen->by_parameters;
  ray.by_shafts = -tangent * by_tangent.inverse() * image->by_shafts;
  return ray;
}

Vector3d camera_centre(const StationModel& model, const UnitReading& reading) {
  return enu_from_camera(model.geometry.chain, corrected_angles(model, reading)).translation();
}

// One equation: v is what the model has over what was seen.
struct Equation {
  double v = 0.0, variance = 1.0;
  Eigen::Matrix<double, 1, kModelParameters> by_parameters =
      Eigen::Matrix<double, 1, kModelParameters>::Zero();
  Eigen::RowVector2d by_shafts = Eigen::RowVector2d::Zero();
  RowVectorXd by_nuisance;
  Vector2d px = Vector2d::Zero();  // of a unit of v, in x or y
};

class EquationBlock : public Block {
 public:
  EquationBlock(const PixelBlockConfig& config, std::vector<TargetSighting> sightings)
      : config_(config),
        sightings_(std::move(sightings)),
        station_(sightings_[0].sighting.station) {
    const auto add = [this](int first, int count) {
      if (std::ranges::find(columns_, first) != columns_.end()) return;
      for (int i = 0; i < count; ++i) columns_.push_back(first + i);
    };
    add(config_.layout.station(station_), kStationParameters);
    for (const TargetSighting& one : sightings_) {
      if (one.sighting.pose) add(config_.layout.pose(*one.sighting.pose), 2);
    }
  }

  int degrees_of_freedom() const override {
    const VectorXd sd = prior_sd();
    return static_cast<int>(sightings_.size()) -
           static_cast<int>((sd.array() == std::numeric_limits<double>::infinity()).count());
  }
  VectorXd initial(const State&) const override { return VectorXd::Zero(prior_sd().size()); }
  BlockEquations equations(const State& state, std::size_t block, double damping) const override;

 protected:
  virtual VectorXd prior_sd() const = 0;
  virtual bool equation(const StationModel& model, const TargetSighting& one,
                        const VectorXd& nuisance, Equation& result) const = 0;
  const std::vector<TargetSighting>& sightings() const { return sightings_; }

 private:
  PixelBlockConfig config_;
  std::vector<TargetSighting> sightings_;
  std::size_t station_;
  std::vector<int> columns_;
};

BlockEquations EquationBlock::equations(const State& state, std::size_t block,
                                        double damping) const {
  const VectorXd sd = prior_sd();
  const VectorXd& nuisance = state.nuisances[block];
  const Index columns = static_cast<Index>(columns_.size()), size = columns + sd.size();
  MatrixXd N = MatrixXd::Zero(size, size);
  VectorXd b = VectorXd::Zero(size);
  double squares = 0.0;
  BlockEquations failed;
  failed.columns = columns_;
  failed.valid = false;
  std::vector<Vector2d> residuals;
  for (const TargetSighting& one : sightings_) {
    Equation here;
    if (!equation(posed_model(state, one.sighting), one, nuisance, here)) return failed;
    RowVectorXd J = RowVectorXd::Zero(size);
    J.head<kModelParameters>() = here.by_parameters;
    J.tail(sd.size()) = here.by_nuisance;
    double variance = here.variance;
    if (one.sighting.pose) {
      const auto at = std::ranges::find(columns_, config_.layout.pose(*one.sighting.pose));
      J.segment<2>(at - columns_.begin()) = here.by_shafts;
    } else {
      variance += here.by_shafts.squaredNorm() * std::pow(one.sighting.pose_sd_rad, 2);
    }
    N.noalias() += J.transpose() * J / variance;
    b.noalias() += J.transpose() * (here.v / variance);
    squares += here.v * here.v / variance;
    residuals.emplace_back(-here.v * here.px);
  }
  for (Index i = 0; i < sd.size(); ++i) {
    if (std::isinf(sd[i])) continue;
    const double weight = 1.0 / std::pow(std::max(sd[i], 1e-7), 2);
    N(columns + i, columns + i) += weight;
    b[columns + i] += weight * nuisance[i];
    squares += weight * nuisance[i] * nuisance[i];
  }
  BlockEquations result = eliminated(N, b, squares, columns, 0, damping);
  result.columns = columns_;
  result.weights.assign(residuals.size(), 1.0);
  result.residuals = std::move(residuals);
  return result;
}

class LevelLine : public EquationBlock {
 public:
  using EquationBlock::EquationBlock;

 protected:
  VectorXd prior_sd() const override { return Vector2d(sightings().front().facts.sd, kSquare_rad); }
  // The line lies in the plane of the two rays, so that the plane's normal is square to it.
  bool equation(const StationModel& model, const TargetSighting& one, const VectorXd& nuisance,
                Equation& result) const override {
    const auto first = ray_of(model, one.sighting.reading, one.sighting.pixel);
    const auto second = ray_of(model, one.sighting.reading, one.facts.second_px);
    if (!first || !second) return false;
    const Vector3d n = first->direction.cross(second->direction), up = Vector3d::UnitZ();
    const Vector3d unit = n.normalized();
    const Vector3d middle = first->direction + second->direction;
    const double level = middle.head<2>().norm();
    const Vector3d forward = Vector3d(middle.x(), middle.y(), 0.0) / level;
    const Vector3d right(forward.y(), -forward.x(), 0.0);
    const double level_off = nuisance[0], turned = nuisance[1];
    const Vector3d along = std::cos(turned) * right + std::sin(turned) * forward;
    const Vector3d line = along + level_off * up;
    const Vector3d line_by_azimuth = -std::cos(turned) * forward + std::sin(turned) * right;
    const auto by = [&](const Vector3d& d_first, const Vector3d& d_second) {
      const Vector3d dn = d_first.cross(second->direction) + first->direction.cross(d_second);
      const double d_azimuth = right.dot(d_first + d_second) / level;
      return (dn.dot(line) - unit.dot(dn) * unit.dot(line)) / n.norm() +
             unit.dot(line_by_azimuth) * d_azimuth;
    };
    result.v = unit.dot(line);
    for (int k = 0; k < kModelParameters; ++k) {
      result.by_parameters[k] = by(first->by_parameters.col(k), second->by_parameters.col(k));
    }
    for (int k = 0; k < 2; ++k) {
      result.by_shafts[k] = by(first->by_shafts.col(k), second->by_shafts.col(k));
    }
    result.by_nuisance.resize(2);
    result.by_nuisance << unit.z(), unit.dot(std::cos(turned) * forward - std::sin(turned) * right);
    const double apart_px = (one.facts.second_px - one.sighting.pixel).norm();
    result.variance = 2.0 * std::pow(one.sighting.sd_px / apart_px, 2);
    result.px.y() = 0.5 * apart_px;
    return true;
  }
};

class Cross : public EquationBlock {
 public:
  using EquationBlock::EquationBlock;

 protected:
  VectorXd prior_sd() const override { return VectorXd::Constant(1, sightings().front().facts.sd); }
  bool equation(const StationModel& model, const TargetSighting& one, const VectorXd& nuisance,
                Equation& result) const override {
    const StationModel head = head_alone(model);
    const auto ray = ray_of(head, {}, one.sighting.pixel);
    if (!ray) return false;
    const Vector3d centre = camera_centre(head, {});
    const Vector3d& d = ray->direction;
    const double forward = std::hypot(d.x(), d.z());
    if (d.x() <= 0.0) return false;
    const Vector3d ahead(d.x() / forward, 0.0, d.z() / forward);
    const double away_m = (one.facts.distance_m - centre.dot(ahead)) / forward;
    result.v = -(centre.y() + away_m * d.y()) - one.facts.offset_m - nuisance[0];
    const Eigen::RowVector3d by_ray =
        -away_m * (Vector3d::UnitY() - d.y() / forward * ahead).transpose();
    result.by_parameters = by_ray * ray->by_parameters;
    // Of the head alone only camera and mounting are parameters; its axes do not turn it.
    for (const int k : {kHeading, kTiltX, kTiltY, kTrunnion}) result.by_parameters[k] = 0.0;
    for (int k = kPanCos1; k <= kExposureOffset; ++k) result.by_parameters[k] = 0.0;
    result.by_nuisance = RowVectorXd::Constant(1, -1.0);
    result.px.x() = model.geometry.camera.fx_px / one.facts.distance_m;
    const double tape = kTape_m * d.y() / forward;
    result.variance = std::pow(one.sighting.sd_px / result.px.x(), 2) + tape * tape;
    return true;
  }
};

class Rulers : public EquationBlock {
 public:
  Rulers(const PixelBlockConfig& config, std::vector<TargetSighting> all)
      : EquationBlock(config, std::move(all)) {
    for (const TargetSighting& one : sightings()) {
      if (index(one.name) == names_.size()) {
        names_.push_back(one.name);
        sds_.push_back(one.facts.sd);
      }
    }
  }

 protected:
  VectorXd prior_sd() const override {
    VectorXd sd(static_cast<Index>(1 + names_.size()));
    sd[0] = std::numeric_limits<double>::infinity();
    for (Index i = 1; i < sd.size(); ++i) sd[i] = sds_[static_cast<std::size_t>(i - 1)];
    return sd;
  }
  bool equation(const StationModel& model, const TargetSighting& one, const VectorXd& nuisance,
                Equation& result) const override {
    const auto ray = ray_of(model, one.sighting.reading, one.sighting.pixel);
    if (!ray) return false;
    const Vector3d& d = ray->direction;
    const double level = d.head<2>().norm(), slope = d.z() / level;
    const auto own = static_cast<Index>(1 + index(one.name));
    // The distance is from the pan axis, the camera stands before it.
    const Vector3d centre = camera_centre(model, one.sighting.reading);
    const double away_m = one.facts.distance_m - centre.head<2>().dot(d.head<2>()) / level;
    result.v = centre.z() + away_m * slope - one.facts.offset_m - nuisance[0] - nuisance[own];
    Eigen::RowVector3d by_ray(-d.x() * slope / level, -d.y() * slope / level, 1.0);
    by_ray *= away_m / level;
    result.by_parameters = by_ray * ray->by_parameters;
    result.by_shafts = by_ray * ray->by_shafts;
    result.by_nuisance = RowVectorXd::Zero(nuisance.size());
    result.by_nuisance[0] = result.by_nuisance[own] = -1.0;
    result.px.y() = model.geometry.camera.fy_px / away_m;
    result.variance =
        std::pow(one.sighting.sd_px / result.px.y(), 2) + std::pow(kTape_m * slope, 2);
    return true;
  }

 private:
  std::size_t index(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
  }

  std::vector<std::string> names_;
  std::vector<double> sds_;
};

}  // namespace

StationModel head_alone(const StationModel& model) {
  StationModel head = model;
  ChainParameters& chain = head.geometry.chain;
  chain.heading_rad = 0.5 * kPi;
  chain.tilt_x_rad = chain.tilt_y_rad = chain.trunnion_rad = 0.0;
  chain.pan_zero_rad = chain.tilt_zero_rad = 0.0;
  chain.ground_to_origin_m.setZero();
  chain.origin_to_azi_m.setZero();
  chain.azi_to_ele_m.setZero();
  // Gears without errors.
  head.pan = {head.pan.counts_per_turn, head.pan.worm_teeth};
  head.tilt = {head.tilt.counts_per_turn, head.tilt.worm_teeth};
  head.exposure_offset_s = 0.0;
  return head;
}

BlockPtr level_line_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings) {
  return std::make_shared<LevelLine>(config, std::move(sightings));
}
BlockPtr cross_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings) {
  return std::make_shared<Cross>(config, std::move(sightings));
}
BlockPtr ruler_block(const PixelBlockConfig& config, std::vector<TargetSighting> sightings) {
  return std::make_shared<Rulers>(config, std::move(sightings));
}

}  // namespace ols::calibration
