// The block of a target's sightings.
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "calibration/block.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Beyond so many deviations a scene point counts with its distance, no longer with its square
// (Huber): features that were matched wrongly, things that moved.
constexpr double kRobust = 2.5;

// A shared pose's errors stand in the state as turns of the two shafts.
StationModel posed(StationModel model, const Vector2d& off_rad) {
  model.geometry.chain.pan_zero_rad += off_rad[0];
  model.geometry.chain.tilt_zero_rad += off_rad[1];
  return model;
}

// Across and up as seen from the station, by the target's x: as long as the ray is.
Eigen::Matrix<double, 3, 2> shift_of(const Eigen::Vector3d& ray) {
  return ray.norm() * tangent_basis(azimuth_elevation_from_enu(ray));
}

class PixelBlock : public Block {
 public:
  PixelBlock(TargetPtr target, std::vector<Sighting> sightings, PixelBlockConfig config)
      : target_(std::move(target)), sightings_(std::move(sightings)), config_(std::move(config)) {
    for (const Sighting& one : sightings_) {
      add(config_.layout.station(one.station), kStationParameters);
      if (one.pose) add(config_.layout.pose(*one.pose), 2);
    }
    if (const auto on = target_->on_station()) add(config_.layout.station(*on), kStationParameters);
    add(config_.layout.ut1(), 1);
    prior_sd_ = target_->prior_sd();
  }

  int degrees_of_freedom() const override {
    int free = 0;
    for (Index i = 0; i < prior_sd_.size(); ++i) free += std::isinf(prior_sd_[i]) ? 1 : 0;
    return 2 * static_cast<int>(sightings_.size()) - free;
  }
  VectorXd initial(const State& state) const override {
    return target_->initial(state, sightings_);
  }
  std::optional<double> heading(const State& state, std::size_t block) const override;
  BlockPtr of_station(std::size_t station) const override {
    std::vector<Sighting> own;
    std::ranges::copy_if(sightings_, std::back_inserter(own),
                         [station](const Sighting& one) { return one.station == station; });
    if (own.empty()) return nullptr;
    return std::make_shared<PixelBlock>(target_, std::move(own), config_);
  }
  BlockEquations equations(const State& state, std::size_t block, double damping) const override;

 private:
  // One sighting's residual and its rows of the Jacobian, over (columns, shift, nuisance).
  struct Row {
    Vector2d v;
    Matrix2d W;
    MatrixXd J;
  };
  void add(int first, int count) {
    if (position(first) >= 0) return;
    for (int i = 0; i < count; ++i) columns_.push_back(first + i);
  }
  Index position(int column) const {
    const auto found = std::ranges::find(columns_, column);
    return found == columns_.end() ? -1 : found - columns_.begin();
  }
  bool row(const State& state, const VectorXd& nuisance, const Sighting& one, Row& row) const;
  void fill(const Sighting& one, const PixelPrediction& image, const TargetView& view,
            MatrixXd& J) const;
  // What a sighting's own pose and its target's own place add to the pixel's covariance.
  Matrix2d weight(const Sighting& one, const PixelPrediction& image, const TargetView& view) const;

  TargetPtr target_;
  std::vector<Sighting> sightings_;
  PixelBlockConfig config_;
  std::vector<int> columns_;
  VectorXd prior_sd_;
};

void PixelBlock::fill(const Sighting& one, const PixelPrediction& image, const TargetView& view,
                      MatrixXd& J) const {
  const Index station = position(config_.layout.station(one.station));
  J.middleCols<kModelParameters>(station) = image.by_parameters;
  // A scene point's place is given in the station's own frame: it moves with the station.
  if (view.moves_with_us) J.middleCols<3>(station + kEast).setZero();
  J.col(station + kRefraction) = image.by_x * view.by_refraction;
  J.col(station + kAir) = image.by_x * view.by_air;
  J.col(position(config_.layout.ut1())) = image.by_x * view.by_ut1;
  if (one.pose) J.middleCols<2>(position(config_.layout.pose(*one.pose))) = image.by_shafts;
  if (const auto on = target_->on_station()) {
    const Index other = position(config_.layout.station(*on)) + kEast;
    J.middleCols<3>(other) += image.by_x * view.by_position;
  }
  const Index columns = static_cast<Index>(columns_.size());
  J.middleCols<2>(columns) = image.by_x * shift_of(image.ray_enu);
  J.rightCols(view.by_nuisance.cols()) =
      image.by_x * view.by_nuisance.topRows<3>() + image.by_w * view.by_nuisance.bottomRows<1>();
}

Matrix2d PixelBlock::weight(const Sighting& one, const PixelPrediction& image,
                            const TargetView& view) const {
  Matrix2d R = one.sd_px * one.sd_px * Matrix2d::Identity();
  const double pose_sd_rad = config_.pose_sd_rad[one.station];
  if (!one.pose) R += pose_sd_rad * pose_sd_rad * image.by_shafts * image.by_shafts.transpose();
  R += view.white_sd_m * view.white_sd_m * image.by_x * image.by_x.transpose();
  return R.inverse();
}

bool PixelBlock::row(const State& state, const VectorXd& nuisance, const Sighting& one,
                     Row& row) const {
  const TargetView view = target_->view(state, one, nuisance);
  const StationModel& model = state.stations[one.station].model;
  const auto image = predict_pixel(one.pose ? posed(model, state.poses[*one.pose]) : model,
                                   one.reading, view.point);
  if (!image || !image->pixel.allFinite()) return false;
  row.v = image->pixel - one.pixel;
  row.W = weight(one, *image, view);
  row.J.setZero(2, static_cast<Index>(columns_.size()) + 2 + nuisance.size());
  fill(one, *image, view, row.J);
  return true;
}

BlockEquations PixelBlock::equations(const State& state, std::size_t block, double damping) const {
  const VectorXd& nuisance = state.nuisances[block];
  const Index columns = static_cast<Index>(columns_.size()), size = columns + 2 + nuisance.size();
  MatrixXd N = MatrixXd::Zero(size, size);
  VectorXd b = VectorXd::Zero(size);
  BlockEquations failed;
  failed.columns = columns_;
  failed.valid = false;
  double squares = 0.0;
  std::vector<Vector2d> residuals;
  std::vector<double> weights;
  for (const Sighting& one : sightings_) {
    Row here;
    if (!row(state, nuisance, one, here)) return failed;
    const double length = std::sqrt(here.v.dot(here.W * here.v));
    const bool far = config_.robust && length > kRobust;
    const double w = far ? kRobust / length : 1.0;
    const MatrixXd WJ = w * here.W * here.J;
    N.noalias() += here.J.transpose() * WJ;
    b.noalias() += WJ.transpose() * here.v;
    squares += far ? kRobust * (2.0 * length - kRobust) : length * length;
    residuals.push_back(-here.v);
    weights.push_back(w);
  }
  for (Index i = 0; i < nuisance.size(); ++i) {
    if (std::isinf(prior_sd_[i])) continue;
    // A place that is known exactly still needs a number.
    const double weight = 1.0 / std::pow(std::max(prior_sd_[i], 1e-6), 2);
    N(columns + 2 + i, columns + 2 + i) += weight;
    b[columns + 2 + i] += weight * nuisance[i];
    squares += weight * nuisance[i] * nuisance[i];
  }
  BlockEquations result = eliminated(N, b, squares, columns, 2, damping);
  result.columns = columns_;
  result.residuals = std::move(residuals);
  result.weights = std::move(weights);
  return result;
}

std::optional<double> PixelBlock::heading(const State& state, std::size_t block) const {
  if (!config_.absolute) return std::nullopt;
  const Sighting& one = sightings_.front();
  const StationModel& model = state.stations[one.station].model;
  const auto seen = predict_direction(model, one.reading, one.pixel);
  if (!seen) return std::nullopt;
  const TargetView view = target_->view(state, one, state.nuisances[block]);
  const double there = azimuth_elevation_from_enu(view.point.x).azimuth_rad;
  return model.geometry.chain.heading_rad + wrap_pi(there - seen->direction.azimuth_rad);
}

}  // namespace

BlockPtr pixel_block(TargetPtr target, std::vector<Sighting> sightings,
                     const PixelBlockConfig& config) {
  return std::make_shared<PixelBlock>(std::move(target), std::move(sightings), config);
}

}  // namespace ols::calibration
