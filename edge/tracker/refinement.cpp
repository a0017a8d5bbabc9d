#include "edge/tracker/refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace ols {
namespace {

constexpr double kContext = 1.3;  // of the box, looked at
constexpr int kLeastSide = 7;     // samples along a side
constexpr int kMostSide = 40;
constexpr double kMostStep = 0.35;  // of the box, from where it starts
constexpr int kMostSteps = 15;

int samples_along(double size_px, int reduction) {
  const double wanted = std::round(kContext * size_px / reduction);
  return std::clamp(static_cast<int>(wanted), kLeastSide, kMostSide);
}

}  // namespace

// The weighted normal equations of (shift u, shift v, gain, offset) and what was left over.
struct PositionRefiner::Normal {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d spread = Eigen::Matrix4d::Zero();  // with the squares of the weights
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double squares = 0.0;
  double weights = 0.0;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  // of (template, image, 1), for correlation

  double scale() const { return std::max(0.5, std::sqrt(squares / weights)); }
  double correlation() const {
    const double n = moments(2, 2);
    const double covariance = moments(0, 1) / n - moments(0, 2) * moments(1, 2) / (n * n);
    const double a = moments(0, 0) / n - moments(0, 2) * moments(0, 2) / (n * n);
    const double b = moments(1, 1) / n - moments(1, 2) * moments(1, 2) / (n * n);
    return a > 0.0 && b > 0.0 ? covariance / std::sqrt(a * b) : 0.0;
  }
};

PositionRefiner::PositionRefiner(const View& view, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector2d& size_px) {
  const int columns = samples_along(size_px.x(), view.reduction);
  const int rows = samples_along(size_px.y(), view.reduction);
  // Steps of whole pixels of the view from a whole pixel: the template is not interpolated where it
  // is not larger than the grid.
  const double step_x =
      std::max(1.0, std::round(kContext * size_px.x() / view.reduction / columns));
  const double step_y = std::max(1.0, std::round(kContext * size_px.y() / view.reduction / rows));
  const double centre_x = view.x_of(pixel.x());
  const double centre_y = view.y_of(pixel.y());
  const double first_x = std::round(centre_x - (columns - 1) / 2.0 * step_x);
  const double first_y = std::round(centre_y - (rows - 1) / 2.0 * step_y);
  const double width = size_px.x() / view.reduction;
  const double height = size_px.y() / view.reduction;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double x = first_x + i * step_x;
      const double y = first_y + j * step_y;
      const auto at = [&](double dx, double dy) {
        return static_cast<double>(bilinear(view.image, x + dx, y + dy));
      };
      // Sobel's smoothed differences: half as noisy as plain ones.
      const double along_x =
          (2.0 * (at(1, 0) - at(-1, 0)) + at(1, -1) - at(-1, -1) + at(1, 1) - at(-1, 1)) / 8.0;
      const double along_y =
          (2.0 * (at(0, 1) - at(0, -1)) + at(-1, 1) - at(-1, -1) + at(1, 1) - at(1, -1)) / 8.0;
      const double u = (x - centre_x) / width;
      const double v = (y - centre_y) / height;
      const double outside = std::max({std::abs(u), std::abs(v), 0.5}) - 0.5;
      samples_.push_back({u, v, at(0, 0), along_x * width, along_y * height,
                          1.0 / (1.0 + 40.0 * outside * outside * 4.0)});
    }
  }
}

void PositionRefiner::set_mask(const MaskPatch& mask) {
  constexpr double kBackground = 0.1;
  for (Sample& sample : samples_) {
    // The mask's pixels within one of the sample's place: the target's edge tells most.
    const int column = static_cast<int>(std::floor((sample.u + 0.5) * kPatchSide));
    const int row = static_cast<int>(std::floor((sample.v + 0.5) * kPatchSide));
    int most = 0;
    for (int j = std::max(0, row - 1); j <= std::min(kPatchSide - 1, row + 1); ++j) {
      for (int i = std::max(0, column - 1); i <= std::min(kPatchSide - 1, column + 1); ++i) {
        most = std::max<int>(most, mask[static_cast<std::size_t>(j * kPatchSide + i)]);
      }
    }
    sample.weight = kBackground + (1.0 - kBackground) * most / 255.0;
  }
}

PositionRefiner::Normal PositionRefiner::accumulate(const View& view, const Eigen::Vector2d& pixel,
                                                    const Eigen::Vector2d& size_px,
                                                    const Eigen::Vector4d& state,
                                                    double scale) const {
  Normal normal;
  for (const Sample& sample : samples_) {
    const double x = view.x_of(pixel.x() + sample.u * size_px.x());
    const double y = view.y_of(pixel.y() + sample.v * size_px.y());
    const auto now = static_cast<double>(bilinear(view.image, x, y));
    const double residual = now - state(2) * sample.gray - state(3);
    // Huber: what covers part of the target, or moves behind it, counts less.
    const double limit = 2.0 * scale;
    const double robust = std::abs(residual) > limit ? limit / std::abs(residual) : 1.0;
    const double weight = sample.weight * robust;
    const Eigen::Vector4d row(sample.gradient_u, sample.gradient_v, sample.gray, 1.0);
    normal.matrix += weight * row * row.transpose();
    normal.spread += weight * weight * row * row.transpose();
    normal.right += weight * row * residual;
    normal.squares += weight * residual * residual;
    normal.weights += weight;
    const Eigen::Vector3d moment(sample.gray, now, 1.0);
    normal.moments += sample.weight * moment * moment.transpose();
  }
  return normal;
}

std::optional<RefinedPosition> PositionRefiner::refine(const View& view,
                                                       const Eigen::Vector2d& start,
                                                       const Eigen::Vector2d& size_px) const {
  Eigen::Vector2d pixel = start;
  Eigen::Vector4d state(0.0, 0.0, 1.0, 0.0);
  double scale = 1e3;  // no robust weights in the first step
  Normal normal;
  for (int step = 0; step < kMostSteps; ++step) {
    normal = accumulate(view, pixel, size_px, state, scale);
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal.matrix);
    if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
    const Eigen::Vector4d change = solver.solve(normal.right);
    // The image at `pixel` is the template seen from change off it: step back by that.
    const Eigen::Vector2d shift = change.head<2>().cwiseProduct(size_px);
    if (!shift.allFinite()) return std::nullopt;
    pixel -= shift;
    state.tail<2>() += change.tail<2>();
    const Eigen::Vector2d from_start = (pixel - start).cwiseQuotient(size_px);
    if (from_start.cwiseAbs().maxCoeff() > kMostStep) return std::nullopt;
    scale = normal.scale();
    if (step > 2 && shift.norm() < 1e-3) break;
  }
  normal = accumulate(view, pixel, size_px, state, scale);
  if (state(2) < 0.2 || state(2) > 5.0) return std::nullopt;
  const Eigen::Matrix4d inverse = normal.matrix.inverse();
  const double variance = normal.squares / normal.weights;
  const Eigen::Matrix4d covariance = variance * inverse * normal.spread * inverse.transpose();
  const Eigen::Matrix2d to_px = size_px.asDiagonal();
  RefinedPosition refined;
  refined.pixel = pixel;
  refined.covariance_px2 = to_px * covariance.topLeftCorner<2, 2>() * to_px;
  refined.correlation = normal.correlation();
  if (!refined.covariance_px2.allFinite() || !std::isfinite(refined.correlation)) {
    return std::nullopt;
  }
  return refined;
}

}  // namespace ols
