#include "edge/tracker/refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace ols::tracker {
namespace {

constexpr double kContext = 1.3;       // of the box; area used
constexpr int kLeastSide = 7;          // samples along a side
constexpr std::size_t kMost = 2500;    // samples; of a larger target the most informative ones
constexpr double kMostLookedAt = 1e5;  // candidates for these
constexpr double kLeastSeen = 0.5;     // of the samples' weight, in the image
constexpr double kMostStep = 0.35;     // of the box, from its start
constexpr double kMostGrowth = 0.25;   // of the box, from its initial size
constexpr int kMostSteps = 15;
constexpr double kMostUnsettled = 0.02;  // of the box, in the last step
constexpr double kSizeSd = 0.02;         // of the initial size, relative

int samples_along(double size_px, int reduction) {
  return std::max(kLeastSide, static_cast<int>(std::round(kContext * size_px / reduction)));
}

// Of the sample in this column and row; blocks do not overlap.
int block_of(int column, int row, int columns) {
  const int side = std::clamp(columns / 6, 2, 6);
  return row / side * columns + column / side;
}

// Keys' cubic convolution: linear interpolation would blur between the pixels and bias the position
// by its sub-pixel phase.
std::array<double, 4> cubic_weights(double t) {
  return {t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t),
          t * (0.5 + t * (2.0 - 1.5 * t)), t * t * (-0.5 + 0.5 * t)};
}

double cubic(const cv::Mat& image, double x, double y) {
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  if (column < 1 || row < 1 || column + 2 >= image.cols || row + 2 >= image.rows) {
    return static_cast<double>(bilinear(image, x, y));
  }
  const auto wx = cubic_weights(x - column);
  const auto wy = cubic_weights(y - row);
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    const auto* line = image.ptr<std::uint8_t>(row - 1 + j) + column - 1;
    sum += wy[static_cast<std::size_t>(j)] *
           (wx[0] * line[0] + wx[1] * line[1] + wx[2] * line[2] + wx[3] * line[3]);
  }
  return sum;
}

}  // namespace

// The weighted normal equations of the Parameters, and the residuals.
struct PositionRefiner::Normal {
  Matrix matrix = Matrix::Zero();
  Matrix spread = Matrix::Zero();  // with squared weights
  Parameters right = Parameters::Zero();
  Matrix blocks = Matrix::Zero();  // likewise, if a block's residuals are fully correlated
  int block_count = 0;
  double squares = 0.0;
  double weights = 0.0;
  double weight_squares = 0.0;
  double seen = 0.0;                                  // weight of the samples in the image
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  // of (template, image, 1), for correlation

  // Both images are rounded to whole grey levels; the parameters have fitted part of the noise.
  double variance() const {
    const double count = weights * weights / weight_squares;
    const double left = std::max(1.0, count - static_cast<double>(Parameters::SizeAtCompileTime));
    return std::max(2.0 / 12.0, squares / weights * count / left);
  }
  double scale() const { return std::max(0.5, std::sqrt(variance())); }
  double correlation() const {
    const double n = moments(2, 2);
    const double covariance = moments(0, 1) / n - moments(0, 2) * moments(1, 2) / (n * n);
    const double a = moments(0, 0) / n - moments(0, 2) * moments(0, 2) / (n * n);
    const double b = moments(1, 1) / n - moments(1, 2) * moments(1, 2) / (n * n);
    return a > 0.0 && b > 0.0 ? covariance / std::sqrt(a * b) : 0.0;
  }
  // Prior: the size is unchanged, to kSizeSd; `off` is the logarithm of its change.
  void hold_size(const Eigen::Vector2d& off) {
    const double stiffness = variance() / (kSizeSd * kSizeSd);
    matrix.diagonal().segment<2>(2).array() += stiffness;
    spread.diagonal().segment<2>(2).array() += stiffness;
    blocks.diagonal().segment<2>(2).array() += stiffness * variance();
    right.segment<2>(2) += stiffness * off;
  }
  void fix_size() {
    for (Matrix* each : {&matrix, &spread, &blocks}) {
      each->middleRows<2>(2).setZero();
      each->middleCols<2>(2).setZero();
    }
    matrix.diagonal().segment<2>(2).setConstant(matrix.trace());
    right.segment<2>(2).setZero();
  }
};

PositionRefiner::PositionRefiner(const FrameView& view, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector2d& size_px) {
  const int columns = samples_along(size_px.x(), view.reduction);
  const int rows = samples_along(size_px.y(), view.reduction);
  const double centre_x = view.x_of(pixel.x());
  const double centre_y = view.y_of(pixel.y());
  // Whole pixels of the view: the template is not interpolated.
  const auto first_x = static_cast<int>(std::round(centre_x - (columns - 1) / 2.0));
  const auto first_y = static_cast<int>(std::round(centre_y - (rows - 1) / 2.0));
  const Eigen::Vector2d size = size_px / view.reduction;
  const int step = columns * rows > kMostLookedAt
                       ? static_cast<int>(std::ceil(std::sqrt(columns * rows / kMostLookedAt)))
                       : 1;
  for (int j = 0; j < rows; j += step) {
    for (int i = 0; i < columns; i += step) {
      const cv::Point at(first_x + i, first_y + j);
      if (!cv::Rect({0, 0}, view.image.size()).contains(at)) continue;
      const Eigen::Vector2d place((at.x - centre_x) / size.x(), (at.y - centre_y) / size.y());
      samples_.push_back(sample_of(view.image, at, place, size));
      samples_.back().block = block_of(i, j, columns);
    }
  }
  keep_steepest(size_px);
  sort_by_blocks();
  find_anchor();
}

// `place` in the box, whose size is in the view's pixels.
PositionRefiner::Sample PositionRefiner::sample_of(const cv::Mat& image, const cv::Point& at,
                                                   const Eigen::Vector2d& place,
                                                   const Eigen::Vector2d& size) {
  const auto gray = [&](int dx, int dy) {
    const int x = std::clamp(at.x + dx, 0, image.cols - 1);
    const int y = std::clamp(at.y + dy, 0, image.rows - 1);
    return static_cast<double>(image.at<std::uint8_t>(y, x));
  };
  // Sobel's smoothed differences: half the noise of plain ones.
  const double along_x =
      (2.0 * (gray(1, 0) - gray(-1, 0)) + gray(1, -1) - gray(-1, -1) + gray(1, 1) - gray(-1, 1)) /
      8.0;
  const double along_y =
      (2.0 * (gray(0, 1) - gray(0, -1)) + gray(-1, 1) - gray(-1, -1) + gray(1, 1) - gray(1, -1)) /
      8.0;
  const double outside = std::max(place.cwiseAbs().maxCoeff(), 0.5) - 0.5;  // of the box
  const double weight = 1.0 / (1.0 + 160.0 * outside * outside);
  return {place.x(), place.y(), gray(0, 0), along_x * size.x(), along_y * size.y(), weight, 0};
}

// Steep parts of the template determine a position.
void PositionRefiner::keep_steepest(const Eigen::Vector2d& size_px) {
  if (samples_.size() <= kMost) return;
  const auto tells = [&](const Sample& sample) {
    const Eigen::Vector2d slope(sample.gradient_u / size_px.x(), sample.gradient_v / size_px.y());
    return sample.weight * slope.squaredNorm();
  };
  std::nth_element(samples_.begin(), samples_.begin() + kMost, samples_.end(),
                   [&](const Sample& a, const Sample& b) { return tells(a) > tells(b); });
  samples_.resize(kMost);
  samples_.shrink_to_fit();
}

// The centre of the samples that determine the position: there size and position are uncorrelated.
void PositionRefiner::find_anchor() {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Vector2d all = Eigen::Vector2d::Constant(1e-9);
  for (const Sample& sample : samples_) {
    const Eigen::Vector2d slope(sample.gradient_u, sample.gradient_v);
    const Eigen::Vector2d tells = sample.weight * slope.cwiseAbs2();
    sum += tells.cwiseProduct(Eigen::Vector2d(sample.u, sample.v));
    all += tells;
  }
  anchor_ = sum.cwiseQuotient(all);
  all_weight_ = std::accumulate(samples_.begin(), samples_.end(), 0.0,
                                [](double weight, const Sample& s) { return weight + s.weight; });
}

void PositionRefiner::set_mask(const MaskPatch& mask) {
  constexpr double kBackground = 0.1;
  for (Sample& sample : samples_) {
    // The mask's pixels within one of the sample's: the target's edge is the most informative.
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
  find_anchor();
}

void PositionRefiner::sort_by_blocks() {
  std::stable_sort(samples_.begin(), samples_.end(),
                   [](const Sample& a, const Sample& b) { return a.block < b.block; });
}

PositionRefiner::Normal PositionRefiner::accumulate(const FrameView& view, const State& state,
                                                    double scale) const {
  Normal normal;
  Parameters of_block = Parameters::Zero();
  int block = samples_.front().block;
  const Eigen::Vector2d last(view.image.cols - 0.5, view.image.rows - 0.5);
  const auto end_block = [&] {
    normal.blocks += of_block * of_block.transpose();
    ++normal.block_count;
    of_block.setZero();
  };
  for (const Sample& sample : samples_) {
    if (sample.block != block) end_block();
    block = sample.block;
    const double u = sample.u - anchor_.x();
    const double v = sample.v - anchor_.y();
    const double x = view.x_of(state.anchor.x() + u * state.size_px.x());
    const double y = view.y_of(state.anchor.y() + v * state.size_px.y());
    if (x < -0.5 || y < -0.5 || x > last.x() || y > last.y()) continue;
    const double now = cubic(view.image, x, y);
    const double residual = now - state.gain * sample.gray - state.offset;
    // Huber weights: what covers the target, or moves behind it, counts less.
    const double limit = 2.0 * scale;
    const double robust = std::abs(residual) > limit ? limit / std::abs(residual) : 1.0;
    const double weight = sample.weight * robust;
    const double along_u = state.gain * sample.gradient_u;
    const double along_v = state.gain * sample.gradient_v;
    Parameters row;
    row << along_u, along_v, u * along_u, v * along_v, sample.gray, 1.0;
    normal.matrix += weight * row * row.transpose();
    normal.spread += weight * weight * row * row.transpose();
    normal.right += weight * row * residual;
    of_block += weight * row * residual;
    normal.squares += weight * residual * residual;
    normal.weights += weight;
    normal.weight_squares += weight * weight;
    normal.seen += sample.weight;
    const Eigen::Vector3d moment(sample.gray, now, 1.0);
    normal.moments += sample.weight * moment * moment.transpose();
  }
  end_block();
  return normal;
}

std::optional<RefinedPosition> PositionRefiner::refine(
    const FrameView& view, const Eigen::Vector2d& start, const Eigen::Vector2d& size_px,
    const std::optional<Eigen::Vector2d>& likely_size_px) const {
  if (samples_.empty()) return std::nullopt;
  const Eigen::Vector2d first_anchor = start + anchor_.cwiseProduct(size_px);
  const Eigen::Vector2d first_size = likely_size_px.value_or(size_px);
  State state{first_anchor, first_size};
  Eigen::Vector2d shift;
  double scale = 1e3;  // no robust weights in the first step
  for (int step = 0; step < kMostSteps; ++step) {
    const auto normal = normal_at(view, state, scale, likely_size_px);
    if (!normal) return std::nullopt;
    const Eigen::LDLT<Matrix> solver(normal->matrix);
    if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
    const Parameters change = solver.solve(normal->right);
    if (!change.allFinite()) return std::nullopt;
    state.step_back(change);
    const Eigen::Vector2d moved = (state.anchor - first_anchor).cwiseQuotient(first_size);
    const Eigen::Vector2d growth = state.size_px.cwiseQuotient(first_size).array().log();
    if (moved.cwiseAbs().maxCoeff() > kMostStep) return std::nullopt;
    if (growth.cwiseAbs().maxCoeff() > kMostGrowth) return std::nullopt;
    scale = normal->scale();
    shift = change.head<2>().cwiseProduct(first_size);
    const Eigen::Vector2d edges = change.segment<2>(2).cwiseProduct(first_size);
    if (step > 2 && shift.norm() < 1e-3 && edges.norm() < 0.02) break;
  }
  const bool settled = shift.cwiseQuotient(first_size).norm() < kMostUnsettled;
  if (!settled || state.gain < 0.2 || state.gain > 5.0) return std::nullopt;
  const auto normal = normal_at(view, state, scale, likely_size_px);
  return normal ? position_of(state, *normal, shift) : std::nullopt;
}

std::optional<PositionRefiner::Normal> PositionRefiner::normal_at(
    const FrameView& view, const State& state, double scale,
    const std::optional<Eigen::Vector2d>& likely_size_px) const {
  Normal normal = accumulate(view, state, scale);
  if (normal.seen < kLeastSeen * all_weight_) return std::nullopt;
  if (likely_size_px) {
    normal.hold_size(state.size_px.cwiseQuotient(*likely_size_px).array().log());
  } else {
    normal.fix_size();
  }
  return normal;
}

// The image there is the template, shifted by change and scaled: step back by that.
void PositionRefiner::State::step_back(const Parameters& change) {
  anchor -= change.head<2>().cwiseProduct(size_px);
  size_px.array() *= (-change.segment<2>(2)).array().max(-0.1).min(0.1).exp();
  gain += change(4);
  offset += change(5);
}

std::optional<RefinedPosition> PositionRefiner::position_of(const State& state,
                                                            const Normal& normal,
                                                            const Eigen::Vector2d& shift) const {
  const Matrix inverse = normal.matrix.inverse();
  const Matrix covariance = normal.variance() * inverse * normal.spread * inverse.transpose();
  const double freed =
      std::max(1.0, normal.block_count - static_cast<double>(Parameters::SizeAtCompileTime));
  const Matrix by_blocks =
      normal.block_count / freed * inverse * normal.blocks * inverse.transpose();
  RefinedPosition refined;
  refined.centre = state.anchor - anchor_.cwiseProduct(state.size_px);
  refined.size_px = state.size_px;
  // From shift and growth, in sizes, to centre and size, in pixels.
  Eigen::Matrix4d to_px = Eigen::Matrix4d::Zero();
  to_px.topLeftCorner<2, 2>() = to_px.bottomRightCorner<2, 2>() = state.size_px.asDiagonal();
  to_px.topRightCorner<2, 2>() = (-anchor_.cwiseProduct(state.size_px)).asDiagonal();
  refined.covariance_px2 = to_px * covariance.topLeftCorner<4, 4>() * to_px.transpose();
  // The last step's size is uncertainty that remains.
  refined.covariance_px2.topLeftCorner<2, 2>() += shift * shift.transpose();
  const Eigen::Matrix2d size = state.size_px.asDiagonal();
  refined.shared_noise = (size * by_blocks.topLeftCorner<2, 2>() * size).trace() /
                         (size * covariance.topLeftCorner<2, 2>() * size).trace();
  refined.correlation = normal.correlation();
  if (!refined.covariance_px2.allFinite() || !std::isfinite(refined.correlation) ||
      !std::isfinite(refined.shared_noise)) {
    return std::nullopt;
  }
  return refined;
}

}  // namespace ols::tracker
