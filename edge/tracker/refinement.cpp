#include "edge/tracker/refinement.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ols {
namespace {

constexpr double kContext = 1.3;      // of the box, looked at
constexpr int kLeastSide = 7;         // samples along a side
constexpr std::size_t kMost = 2500;   // samples; of a larger target those that tell most
constexpr double kMostStep = 0.35;    // of the box, from where it starts
constexpr double kMostGrowth = 0.25;  // of the box, from what it starts with
constexpr int kMostSteps = 15;
constexpr double kSizeSd = 0.02;  // of the size that it starts with, relative

int samples_along(double size_px, int reduction) {
  return std::max(kLeastSide, static_cast<int>(std::round(kContext * size_px / reduction)));
}

// Of the sample in this column and row; blocks overlap nowhere.
int block_of(int column, int row, int columns) {
  const int side = std::clamp(columns / 6, 2, 6);
  return row / side * columns + column / side;
}

// Keys' cubic convolution: what lies between the pixels is not blurred as by a line, so that the
// position does not lean on where between them the target stands.
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

// The weighted normal equations of the Parameters and what was left over.
struct PositionRefiner::Normal {
  Matrix matrix = Matrix::Zero();
  Matrix spread = Matrix::Zero();  // with the squares of the weights
  Parameters right = Parameters::Zero();
  Matrix blocks = Matrix::Zero();  // likewise, if what is left over in a block is of one piece
  int block_count = 0;
  double squares = 0.0;
  double weights = 0.0;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();  // of (template, image, 1), for correlation

  // Both images are rounded to whole grey levels.
  double variance() const { return std::max(2.0 / 12.0, squares / weights); }
  double scale() const { return std::max(0.5, std::sqrt(variance())); }
  double correlation() const {
    const double n = moments(2, 2);
    const double covariance = moments(0, 1) / n - moments(0, 2) * moments(1, 2) / (n * n);
    const double a = moments(0, 0) / n - moments(0, 2) * moments(0, 2) / (n * n);
    const double b = moments(1, 1) / n - moments(1, 2) * moments(1, 2) / (n * n);
    return a > 0.0 && b > 0.0 ? covariance / std::sqrt(a * b) : 0.0;
  }
  // The size is known beforehand, to kSizeSd; `off` is how far it has gone from that.
  void hold_size(const Eigen::Vector2d& off) {
    const double stiffness = variance() / (kSizeSd * kSizeSd);
    matrix.diagonal().segment<2>(2).array() += stiffness;
    right.segment<2>(2) += stiffness * off;
  }
  void fix_size() {
    matrix.middleRows<2>(2).setZero();
    matrix.middleCols<2>(2).setZero();
    matrix.diagonal().segment<2>(2).setConstant(matrix.trace());
    right.segment<2>(2).setZero();
  }
};

PositionRefiner::PositionRefiner(const View& view, const Eigen::Vector2d& pixel,
                                 const Eigen::Vector2d& size_px) {
  const int columns = samples_along(size_px.x(), view.reduction);
  const int rows = samples_along(size_px.y(), view.reduction);
  const double centre_x = view.x_of(pixel.x());
  const double centre_y = view.y_of(pixel.y());
  // Whole pixels of the view: the template is not interpolated.
  const double first_x = std::round(centre_x - (columns - 1) / 2.0);
  const double first_y = std::round(centre_y - (rows - 1) / 2.0);
  const double width = size_px.x() / view.reduction;
  const double height = size_px.y() / view.reduction;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double x = first_x + i;
      const double y = first_y + j;
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
                          1.0 / (1.0 + 40.0 * outside * outside * 4.0), block_of(i, j, columns)});
    }
  }
  keep_steepest(size_px);
  sort_by_blocks();
  find_anchor(size_px);
}

// A position is told by where the template is steep.
void PositionRefiner::keep_steepest(const Eigen::Vector2d& size_px) {
  if (samples_.size() <= kMost) return;
  const auto tells = [&](const Sample& sample) {
    const Eigen::Vector2d slope(sample.gradient_u / size_px.x(), sample.gradient_v / size_px.y());
    return sample.weight * slope.squaredNorm();
  };
  std::nth_element(samples_.begin(), samples_.begin() + kMost, samples_.end(),
                   [&](const Sample& a, const Sample& b) { return tells(a) > tells(b); });
  samples_.resize(kMost);
}

// The middle of what tells the position: there the size and the place do not depend on each other.
void PositionRefiner::find_anchor(const Eigen::Vector2d& size_px) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Vector2d all = Eigen::Vector2d::Constant(1e-9);
  for (const Sample& sample : samples_) {
    const Eigen::Vector2d slope(sample.gradient_u, sample.gradient_v);
    const Eigen::Vector2d tells = sample.weight * slope.cwiseAbs2();
    sum += tells.cwiseProduct(Eigen::Vector2d(sample.u, sample.v));
    all += tells;
  }
  anchor_ = sum.cwiseQuotient(all);
  anchor_px_ = anchor_.cwiseProduct(size_px);
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

void PositionRefiner::sort_by_blocks() {
  std::stable_sort(samples_.begin(), samples_.end(),
                   [](const Sample& a, const Sample& b) { return a.block < b.block; });
}

PositionRefiner::Normal PositionRefiner::accumulate(const View& view, const State& state,
                                                    double scale) const {
  Normal normal;
  Parameters of_block = Parameters::Zero();
  int block = samples_.front().block;
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
    const double now = cubic(view.image, x, y);
    const double residual = now - state.gain * sample.gray - state.offset;
    // Huber: what covers part of the target, or moves behind it, counts less.
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
    const Eigen::Vector3d moment(sample.gray, now, 1.0);
    normal.moments += sample.weight * moment * moment.transpose();
  }
  end_block();
  return normal;
}

std::optional<RefinedPosition> PositionRefiner::refine(
    const View& view, const Eigen::Vector2d& start, const Eigen::Vector2d& size_px,
    const std::optional<Eigen::Vector2d>& likely_size_px) const {
  const Eigen::Vector2d first_anchor = start + anchor_.cwiseProduct(size_px);
  const Eigen::Vector2d first_size = likely_size_px.value_or(size_px);
  const auto know_size = [&](Normal& normal, const Eigen::Vector2d& size) {
    if (!likely_size_px) return normal.fix_size();
    normal.hold_size(size.cwiseQuotient(first_size).array().log());
  };
  State state{first_anchor, first_size};
  double scale = 1e3;  // no robust weights in the first step
  for (int step = 0; step < kMostSteps; ++step) {
    Normal normal = accumulate(view, state, scale);
    know_size(normal, state.size_px);
    const Eigen::LDLT<Matrix> solver(normal.matrix);
    if (solver.info() != Eigen::Success || solver.rcond() < 1e-12) return std::nullopt;
    const Parameters change = solver.solve(normal.right);
    if (!change.allFinite()) return std::nullopt;
    state.step_back(change);
    const Eigen::Vector2d moved = (state.anchor - first_anchor).cwiseQuotient(first_size);
    const Eigen::Vector2d growth = state.size_px.cwiseQuotient(first_size).array().log();
    if (moved.cwiseAbs().maxCoeff() > kMostStep) return std::nullopt;
    if (growth.cwiseAbs().maxCoeff() > kMostGrowth) return std::nullopt;
    scale = normal.scale();
    const Eigen::Vector2d shift = change.head<2>().cwiseProduct(first_size);
    const Eigen::Vector2d edges = change.segment<2>(2).cwiseProduct(first_size);
    if (step > 2 && shift.norm() < 1e-3 && edges.norm() < 0.02) break;
  }
  if (state.gain < 0.2 || state.gain > 5.0) return std::nullopt;
  Normal normal = accumulate(view, state, scale);
  know_size(normal, first_size);
  return position_of(state, normal);
}

// The image there is the template seen from change off it and larger: step back by that.
void PositionRefiner::State::step_back(const Parameters& change) {
  anchor -= change.head<2>().cwiseProduct(size_px);
  size_px.array() *= (-change.segment<2>(2)).array().max(-0.1).min(0.1).exp();
  gain += change(4);
  offset += change(5);
}

std::optional<RefinedPosition> PositionRefiner::position_of(const State& state,
                                                            const Normal& normal) const {
  const Matrix inverse = normal.matrix.inverse();
  const Matrix covariance = normal.variance() * inverse * normal.spread * inverse.transpose();
  const double freed =
      std::max(1.0, normal.block_count - static_cast<double>(Parameters::SizeAtCompileTime));
  const Matrix by_blocks =
      normal.block_count / freed * inverse * normal.blocks * inverse.transpose();
  const Eigen::Matrix2d to_px = state.size_px.asDiagonal();
  RefinedPosition refined;
  refined.pixel = state.anchor - anchor_px_;
  refined.centre = state.anchor - anchor_.cwiseProduct(state.size_px);
  refined.size_px = state.size_px;
  refined.covariance_px2 = to_px * covariance.topLeftCorner<2, 2>() * to_px;
  refined.shared_noise =
      (to_px * by_blocks.topLeftCorner<2, 2>() * to_px).trace() / refined.covariance_px2.trace();
  refined.correlation = normal.correlation();
  if (!refined.covariance_px2.allFinite() || !std::isfinite(refined.correlation) ||
      !std::isfinite(refined.shared_noise)) {
    return std::nullopt;
  }
  return refined;
}

}  // namespace ols
