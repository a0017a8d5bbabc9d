#include "calibration/block.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace ols::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

std::vector<int> run(int first, int count) {
  std::vector<int> columns;
  columns.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) columns.push_back(first + i);
  return columns;
}

class StationPriorBlock : public Block {
 public:
  StationPriorBlock(const Layout& layout, std::size_t station, const StationMatrix& covariance)
      : station_(station), first_(layout.station(station)) {
    // The inverse of the correlations: the parameters' units differ by many orders. What has no
    // deviation is known exactly, or, as the heading, not at all.
    const StationVector sd = covariance.diagonal().cwiseSqrt();
    StationMatrix correlation = StationMatrix::Identity();
    for (int i = 0; i < kStationParameters; ++i) {
      if (is_free(sd, i)) ++degrees_;
      for (int j = 0; j < i; ++j) {
        if (!is_free(sd, i) || !is_free(sd, j)) continue;
        correlation(i, j) = correlation(j, i) = covariance(i, j) / (sd[i] * sd[j]);
      }
    }
    const StationMatrix inverse = correlation.ldlt().solve(StationMatrix::Identity());
    StationVector weight = StationVector::Zero();
    for (int i = 0; i < kStationParameters; ++i) {
      if (is_free(sd, i)) weight[i] = 1.0 / sd[i];
    }
    information_ = weight.asDiagonal() * inverse * weight.asDiagonal();
  }
  int degrees_of_freedom() const override { return degrees_; }
  BlockEquations equations(const State& state, std::size_t, double) const override {
    const StationVector& x = state.stations[station_].change;
    BlockEquations result;
    result.columns = run(first_, kStationParameters);
    result.information = information_;
    result.gradient = information_ * x;
    result.squares = result.misfit = x.dot(result.gradient);
    return result;
  }

 private:
  static bool is_free(const StationVector& sd, int i) { return sd[i] > 0.0 && i != kHeading; }

  std::size_t station_;
  int first_;
  int degrees_ = 0;
  StationMatrix information_;
};

// Values of their own around zero.
class PriorBlock : public Block {
 public:
  PriorBlock(int first, int count, double sd) : first_(first), count_(count), sd_(sd) {}
  int degrees_of_freedom() const override { return count_; }
  BlockEquations equations(const State& state, std::size_t, double) const override {
    BlockEquations result;
    result.columns = run(first_, count_);
    result.information = MatrixXd::Identity(count_, count_) / (sd_ * sd_);
    result.gradient = values(state) / (sd_ * sd_);
    result.squares = result.misfit = values(state).squaredNorm() / (sd_ * sd_);
    return result;
  }

 protected:
  virtual VectorXd values(const State& state) const = 0;

 private:
  int first_, count_;
  double sd_;
};

class Ut1Block : public PriorBlock {
 public:
  Ut1Block(const Layout& layout, double sd_s) : PriorBlock(layout.ut1(), 1, sd_s) {}

 private:
  VectorXd values(const State& state) const override { return VectorXd::Constant(1, state.ut1_s); }
};

class PoseBlock : public PriorBlock {
 public:
  PoseBlock(const Layout& layout, std::size_t pose, double sd_rad)
      : PriorBlock(layout.pose(pose), 2, sd_rad), pose_(pose) {}

 private:
  VectorXd values(const State& state) const override { return state.poses[pose_]; }

  std::size_t pose_;
};

class LevelBlock : public Block {
 public:
  LevelBlock(const Layout& layout, std::vector<Observation> readings)
      : first_(layout.station(readings.front().station) + kTiltX), readings_(std::move(readings)) {}
  int degrees_of_freedom() const override { return 2 * static_cast<int>(readings_.size()); }
  VectorXd initial(const State&) const override { return Vector2d::Zero(); }
  BlockEquations equations(const State& state, std::size_t block, double damping) const override {
    const ChainParameters& chain = state.stations[readings_.front().station].model.geometry.chain;
    const Vector2d tilt(chain.tilt_x_rad, chain.tilt_y_rad);
    const Vector2d zero = state.nuisances[block];
    MatrixXd N = MatrixXd::Zero(4, 4);
    VectorXd b = VectorXd::Zero(4);
    MatrixXd J(2, 4);
    J << Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity();
    double squares = 0.0;
    std::vector<Vector2d> residuals;
    for (const Observation& one : readings_) {
      const double weight = 1.0 / (one.tilt_sd_rad * one.tilt_sd_rad);
      const Vector2d v = tilt + zero - one.tilt_rad;
      N += weight * J.transpose() * J;
      b += weight * J.transpose() * v;
      squares += weight * v.squaredNorm();
      residuals.push_back(-v);
    }
    const double zero_weight = 1.0 / std::pow(readings_.front().zero_sd_rad, 2);
    N.bottomRightCorner<2, 2>() += zero_weight * Eigen::Matrix2d::Identity();
    b.tail<2>() += zero_weight * zero;
    squares += zero_weight * zero.squaredNorm();
    BlockEquations result = eliminated(N, b, squares, 2, 0, damping);
    result.columns = run(first_, 2);
    result.residuals = std::move(residuals);
    result.weights.assign(readings_.size(), 1.0);
    return result;
  }

 private:
  int first_;
  std::vector<Observation> readings_;
};

}  // namespace

StationModel posed_model(const State& state, const Sighting& sighting) {
  StationModel model = state.stations[sighting.station].model;
  if (sighting.pose) {
    const Vector2d& off_rad = state.poses[*sighting.pose];
    model.geometry.chain.pan_zero_rad += off_rad[0];
    model.geometry.chain.tilt_zero_rad += off_rad[1];
  }
  return model;
}

BlockEquations eliminated(const MatrixXd& N, const VectorXd& b, double squares, Index columns,
                          Index shift, double damping) {
  const Index kept = columns + shift, nuisance = N.rows() - kept;
  BlockEquations result;
  result.misfit = result.squares = squares;
  MatrixXd reduced = N.topLeftCorner(kept, kept);
  VectorXd gradient = b.head(kept);
  if (nuisance > 0) {
    MatrixXd own = N.bottomRightCorner(nuisance, nuisance);
    own.diagonal() *= 1.0 + damping;
    const auto solver = own.ldlt();
    result.nuisance_by = solver.solve(N.bottomLeftCorner(nuisance, kept));
    result.nuisance_step = solver.solve(b.tail(nuisance));
    reduced -= N.topRightCorner(kept, nuisance) * result.nuisance_by;
    gradient -= N.topRightCorner(kept, nuisance) * result.nuisance_step;
    result.squares -= b.tail(nuisance).dot(result.nuisance_step);
    result.nuisance_by.conservativeResize(Eigen::NoChange, columns);
  }
  result.information = reduced.topLeftCorner(columns, columns);
  result.gradient = gradient.head(columns);
  if (shift > 0) {
    result.shift_information = reduced.bottomRightCorner<2, 2>();
    result.shift_by = reduced.topRightCorner(columns, 2);
    result.shift_gradient = gradient.tail<2>();
  }
  return result;
}

BlockPtr station_prior_block(const Layout& layout, std::size_t station,
                             const StationMatrix& covariance) {
  return std::make_shared<StationPriorBlock>(layout, station, covariance);
}
BlockPtr ut1_prior_block(const Layout& layout, double sd_s) {
  return std::make_shared<Ut1Block>(layout, sd_s);
}
BlockPtr pose_prior_block(const Layout& layout, std::size_t pose, double sd_rad) {
  return std::make_shared<PoseBlock>(layout, pose, sd_rad);
}
BlockPtr level_block(const Layout& layout, std::vector<Observation> readings) {
  return std::make_shared<LevelBlock>(layout, std::move(readings));
}

}  // namespace ols::calibration
