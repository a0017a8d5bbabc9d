#include "calibration/zoom_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/median.h"

namespace ols::calibration {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// The unknowns: logarithm of the focal length, principal point, radial distortion, and of each
// picture what its pan and tilt are off.
constexpr Eigen::Index kOfLens = 4;
constexpr std::size_t kLeastPairs = 12;
constexpr int kRobustTurns = 8, kTurns = 16;

class Fit {
 public:
  Fit(const StationGeometry& station, const std::vector<PanTilt>& angles,
      const std::vector<ZoomPair>& pairs, const ZoomFitOptions& options)
      : station_(station), angles_(angles), pairs_(pairs), used_(pairs.size(), true) {
    const auto count = kOfLens + 2 * static_cast<Eigen::Index>(angles.size());
    x_ = VectorXd::Zero(count);
    prior_sd_ = VectorXd::Constant(count, options.angle_sd_rad);
    constexpr double kFocalUnknown = 1.0;
    prior_sd_.head<kOfLens>() << kFocalUnknown, options.centre_sd_px, options.centre_sd_px,
        options.k1_sd;
  }

  ZoomFit solve() {
    for (int turn = 0; turn < kTurns; ++turn) {
      improve();
      const std::vector<double> lengths = residual_lengths();
      const double middle = median(lengths);
      if (turn < kRobustTurns) {
        far_sd_ = std::max(1.0, middle);
      } else {
        far_sd_ = std::numeric_limits<double>::infinity();
        leave_out(lengths, middle);
      }
    }
    return result();
  }

 private:
  CameraIntrinsics camera(const VectorXd& x) const {
    CameraIntrinsics camera = station_.camera;
    camera.fx_px *= std::exp(x[0]);
    camera.fy_px *= std::exp(x[0]);
    camera.cx_px += x[1];
    camera.cy_px += x[2];
    camera.k1 += x[3];
    return camera;
  }
  Eigen::Matrix3d attitude(const VectorXd& x, std::size_t picture) const {
    const auto at = kOfLens + 2 * static_cast<Eigen::Index>(picture);
    PanTilt angles = angles_[picture];
    angles.pan_rad += x[at];
    angles.tilt_rad += x[at + 1];
    return enu_from_camera(station_.chain, angles).linear();
  }
  // Where the point is less where it should be, in deviations.
  std::optional<Vector2d> residual(const VectorXd& x, const ZoomPair& pair) const {
    const CameraIntrinsics lens = camera(x);
    const auto ray = unproject(lens, pair.first_px);
    if (!ray) return std::nullopt;
    const auto place =
        project(lens, attitude(x, pair.second).transpose() * attitude(x, pair.first) * *ray);
    if (!place) return std::nullopt;
    return (pair.second_px - *place) / pair.sd_px;
  }
  // With respect to the unknowns that it depends on; the others are zero.
  MatrixXd derivative(const ZoomPair& pair, const Vector2d& here) const {
    MatrixXd J = MatrixXd::Zero(2, x_.size());
    const auto of = [](std::size_t picture) {
      return kOfLens + 2 * static_cast<Eigen::Index>(picture);
    };
    const Eigen::Index first = of(pair.first), second = of(pair.second);
    for (const Eigen::Index i : {Eigen::Index{0}, Eigen::Index{1}, Eigen::Index{2}, Eigen::Index{3},
                                 first, first + 1, second, second + 1}) {
      const double step = i == 0 ? 1e-6 : i < 3 ? 1e-3 : i == 3 ? 1e-5 : 1e-7;
      VectorXd moved = x_;
      moved[i] += step;
      const auto there = residual(moved, pair);
      if (there) J.col(i) = (*there - here) / step;
    }
    return J;
  }
  void improve() {
    N_ = prior_sd_.cwiseAbs2().cwiseInverse().asDiagonal();
    VectorXd b = -x_.cwiseQuotient(prior_sd_.cwiseAbs2());
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto r = used_[i] ? residual(x_, pairs_[i]) : std::nullopt;
      if (!r) continue;
      const MatrixXd J = derivative(pairs_[i], *r);
      const double weight = std::min(1.0, far_sd_ / r->norm());
      N_ += weight * J.transpose() * J;
      b -= weight * J.transpose() * *r;
    }
    x_ += N_.ldlt().solve(b);
  }
  // In deviations.
  std::vector<double> residual_lengths() const {
    std::vector<double> lengths;
    for (const ZoomPair& pair : pairs_) {
      const auto r = residual(x_, pair);
      lengths.push_back(r ? r->norm() : 1e9);
    }
    return lengths;
  }
  // Mismatches, and what moves: by the median of what is left, which they do not reach.
  void leave_out(const std::vector<double>& lengths, double middle) {
    constexpr double kMostMedians = 4.0, kLeast_sd = 4.0;
    const double most = std::max(kLeast_sd, kMostMedians * middle);
    for (std::size_t i = 0; i < pairs_.size(); ++i) used_[i] = lengths[i] < most;
  }
  ZoomFit result() const {
    ZoomFit fit;
    double sum = 0.0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto r = used_[i] ? residual(x_, pairs_[i]) : std::nullopt;
      if (!r) continue;
      sum += r->squaredNorm();
      ++fit.used;
    }
    if (static_cast<std::size_t>(fit.used) < std::max(kLeastPairs, pairs_.size() / 2)) return {};
    fit.rms_sd = std::sqrt(sum / (2.0 * fit.used));
    // What agrees worse than its deviations say is worth less.
    const double worse = std::max(1.0, fit.rms_sd);
    const MatrixXd covariance = N_.ldlt().solve(MatrixXd::Identity(x_.size(), x_.size()));
    fit.point.camera = camera(x_);
    fit.point.focal_sd_px = worse * fit.point.camera.fx_px * std::sqrt(covariance(0, 0));
    fit.point.centre_sd_px = worse * std::sqrt(std::max(covariance(1, 1), covariance(2, 2)));
    return fit;
  }

  const StationGeometry& station_;
  const std::vector<PanTilt>& angles_;
  const std::vector<ZoomPair>& pairs_;
  std::vector<bool> used_;
  // What is off by more counts by its distance, not by its square (Huber): what moves together, as
  // a third of the scenery may, must not take a picture along before it is left out.
  double far_sd_ = std::numeric_limits<double>::infinity();
  VectorXd x_, prior_sd_;
  MatrixXd N_;
};

}  // namespace

ZoomFit fit_zoom(const StationGeometry& station, const std::vector<PanTilt>& angles,
                 const std::vector<ZoomPair>& pairs, const ZoomFitOptions& options) {
  if (pairs.size() < kLeastPairs) return {};
  return Fit(station, angles, pairs, options).solve();
}

}  // namespace ols::calibration
