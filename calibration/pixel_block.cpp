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
  std::size_t sighting_count() const override { return sightings_.size(); }
  BlockPtr with_only(const std::vector<std::size_t>& which) const override {
    std::vector<Sighting> some;
    for (const std::size_t i : which) some.push_back(sightings_[i]);
    return std::make_shared<PixelBlock>(target_, std::move(some), config_);
  }
  BlockEquations equations(const State& state, std::size_t block, double damping) const override;
  void without_each(const State& state, std::size_t block,
                    const TakeEquations& take) const override;

 private:
  // One sighting's residual and its rows of the Jacobian, over (columns, shift, nuisance).
  struct Row {
    Vector2d v;
    Matrix2d W;
    MatrixXd J;
    double weight = 1.0;  // below 1: a robust one
    double squares = 0.0;
  };
  // Normal equations over (columns, shift, nuisance).
  struct Sums {
    MatrixXd N;
    VectorXd b;
    double squares = 0.0;
    // A sighting's, with its robust weight, `sign` 1; -1 takes it out again.
    void add(const Row& row, double sign);
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
  // Of all sightings; nothing where one of them is not valid.
  std::optional<std::vector<Row>> rows(const State& state, const VectorXd& nuisance) const;
  Sums prior_sums(const VectorXd& nuisance) const;
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
  if (!one.pose) {
    R += one.pose_sd_rad * one.pose_sd_rad * image.by_shafts * image.by_shafts.transpose();
  }
  R += view.white_sd_m * view.white_sd_m * image.by_x * image.by_x.transpose();
  return R.inverse();
}

bool PixelBlock::row(const State& state, const VectorXd& nuisance, const Sighting& one,
                     Row& row) const {
  const TargetView view = target_->view(state, one, nuisance);
  const auto image = predict_pixel(posed_model(state, one), one.reading, view.point);
  if (!image || !image->pixel.allFinite()) return false;
  row.v = image->pixel - one.pixel;
  row.W = weight(one, *image, view);
  row.J.setZero(2, static_cast<Index>(columns_.size()) + 2 + nuisance.size());
  fill(one, *image, view, row.J);
  return true;
}

std::optional<std::vector<PixelBlock::Row>> PixelBlock::rows(const State& state,
                                                             const VectorXd& nuisance) const {
  std::vector<Row> all(sightings_.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    Row& one = all[i];
    if (!row(state, nuisance, sightings_[i], one)) return std::nullopt;
    const double length = std::sqrt(one.v.dot(one.W * one.v));
    const bool far = config_.robust && length > kRobust;
    one.weight = far ? kRobust / length : 1.0;
    one.squares = far ? kRobust * (2.0 * length - kRobust) : length * length;
  }
  return all;
}

void PixelBlock::Sums::add(const Row& row, double sign) {
  const MatrixXd WJ = sign * row.weight * row.W * row.J;
  N.noalias() += row.J.transpose() * WJ;
  b.noalias() += WJ.transpose() * row.v;
  squares += sign * row.squares;
}

PixelBlock::Sums PixelBlock::prior_sums(const VectorXd& nuisance) const {
  const Index first = static_cast<Index>(columns_.size()) + 2, size = first + nuisance.size();
  Sums sums{MatrixXd::Zero(size, size), VectorXd::Zero(size)};
  for (Index i = 0; i < nuisance.size(); ++i) {
    if (std::isinf(prior_sd_[i])) continue;
    // A place that is known exactly still needs a number.
    const double weight = 1.0 / std::pow(std::max(prior_sd_[i], 1e-6), 2);
    sums.N(first + i, first + i) += weight;
    sums.b[first + i] += weight * nuisance[i];
    sums.squares += weight * nuisance[i] * nuisance[i];
  }
  return sums;
}

BlockEquations PixelBlock::equations(const State& state, std::size_t block, double damping) const {
  const VectorXd& nuisance = state.nuisances[block];
  const auto all = rows(state, nuisance);
  BlockEquations result;
  result.valid = all.has_value();
  if (all) {
    Sums sums = prior_sums(nuisance);
    for (const Row& one : *all) sums.add(one, 1.0);
    const auto columns = static_cast<Index>(columns_.size());
    result = eliminated(sums.N, sums.b, sums.squares, columns, 2, damping);
    for (const Row& one : *all) {
      result.residuals.emplace_back(-one.v);
      result.weights.push_back(one.weight);
    }
  }
  result.columns = columns_;
  return result;
}

void PixelBlock::without_each(const State& state, std::size_t block,
                              const TakeEquations& take) const {
  const VectorXd& nuisance = state.nuisances[block];
  const auto all = rows(state, nuisance);
  if (!all) return;
  Sums sums = prior_sums(nuisance);
  for (const Row& one : *all) sums.add(one, 1.0);
  for (std::size_t i = 0; i < all->size(); ++i) {
    Sums left = sums;
    left.add((*all)[i], -1.0);
    BlockEquations without =
        eliminated(left.N, left.b, left.squares, static_cast<Index>(columns_.size()), 2, 0.0);
    without.columns = columns_;
    take(i, without);
  }
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
