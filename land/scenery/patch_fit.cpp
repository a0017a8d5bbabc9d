#include "land/scenery/patch_fit.h"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "land/scenery/epipolar_search.h"
#include "land/scenery/sample.h"

namespace ols::scenery {
namespace {

constexpr int kHalf = kPatchHalf + 1;
constexpr double kShapeSd = 0.25;        // of each axis' components
constexpr double kNoise = 2.0;           // gray
constexpr double kFarthestFit_px = 4.0;  // from the start

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

struct Pixel {
  Eigen::Vector2d offset;  // from the patch's centre
  double gray = 0.0, weight = 0.0;
};

std::optional<std::vector<Pixel>> pixels_of(const cv::Mat1f& image, const Eigen::Vector2d& px,
                                            double slope) {
  constexpr double kWeightSd_px = 0.7 * kHalf;
  std::vector<Pixel> pixels;
  for (int j = -kHalf; j <= kHalf; ++j) {
    for (int i = -kHalf; i <= kHalf; ++i) {
      const float gray = sample(image, px.x() + i, px.y() + j + slope * i);
      if (std::isnan(gray)) return std::nullopt;
      const double off = (i * i + j * j) / (kWeightSd_px * kWeightSd_px);
      pixels.push_back({{i, j}, static_cast<double>(gray), std::exp(-0.5 * off)});
    }
  }
  return pixels;
}

// gray = contrast * other(centre + shape * offset) + brightness
class Adjustment {
 public:
  Adjustment(std::vector<Pixel> pixels, const cv::Mat1f& other, const Eigen::Vector2d& start,
             const Eigen::Matrix2d& shape)
      : pixels_(std::move(pixels)),
        other_(other),
        start_(start),
        first_shape_(shape),
        centre_(start),
        shape_(shape) {}

  bool settle() {
    constexpr int kSteps = 11;
    constexpr double kSettled_px = 0.005, kAlmost_px = 0.1;
    if (!begin()) return false;
    double step_px = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      if (!step(step_px)) return false;
      if (step_px < kSettled_px) break;
    }
    return step_px < kAlmost_px;
  }
  PatchFit fit() const {
    const Matrix8 covariance = normal_.inverse() * mean_square_;
    return {centre_, covariance.diagonal().head<2>().cwiseSqrt(), shape_, correlation()};
  }

 private:
  struct Moments {
    double weight = 0.0, mean = 0.0, other_mean = 0.0;
    double square = 0.0, other_square = 0.0, product = 0.0;  // about the means
  };
  double other_at(const Pixel& pixel, double right = 0.0, double down = 0.0) const {
    const Eigen::Vector2d px = centre_ + shape_ * pixel.offset;
    return static_cast<double>(sample(other_, px.x() + right, px.y() + down));
  }
  Moments moments() const {
    Moments m;
    for (const Pixel& pixel : pixels_) {
      m.weight += pixel.weight;
      m.mean += pixel.weight * pixel.gray;
      m.other_mean += pixel.weight * other_at(pixel);
    }
    m.mean /= m.weight;
    m.other_mean /= m.weight;
    for (const Pixel& pixel : pixels_) {
      const double off = pixel.gray - m.mean, other_off = other_at(pixel) - m.other_mean;
      m.square += pixel.weight * off * off;
      m.other_square += pixel.weight * other_off * other_off;
      m.product += pixel.weight * off * other_off;
    }
    return m;
  }
  double correlation() const {
    const Moments m = moments();
    return m.product / std::sqrt(m.square * m.other_square + 1e-9);
  }
  bool begin() {
    const Moments m = moments();
    contrast_ = std::clamp(m.product / std::max(m.other_square, 1e-9), 0.3, 3.0);
    brightness_ = m.mean - contrast_ * m.other_mean;
    return std::isfinite(brightness_);
  }
  bool step(double& step_px) {
    normal_.setZero();
    Vector8 right = Vector8::Zero();
    double squares = 0.0, weights = 0.0;
    for (const Pixel& pixel : pixels_) {
      const double gray = other_at(pixel);
      const double dx = 0.5 * contrast_ * (other_at(pixel, 1.0) - other_at(pixel, -1.0));
      const double dy = 0.5 * contrast_ * (other_at(pixel, 0.0, 1.0) - other_at(pixel, 0.0, -1.0));
      if (std::isnan(gray + dx + dy)) return false;
      const double u = pixel.offset.x(), v = pixel.offset.y();
      const Vector8 by{dx, dy, dx * u, dx * v, dy * u, dy * v, gray, 1.0};
      const double residual = pixel.gray - contrast_ * gray - brightness_;
      normal_ += pixel.weight * by * by.transpose();
      right += pixel.weight * residual * by;
      squares += pixel.weight * residual * residual;
      weights += pixel.weight;
    }
    mean_square_ = squares / weights;
    const double keep = (mean_square_ + kNoise * kNoise) / (kShapeSd * kShapeSd);
    const Eigen::Matrix2d back = first_shape_ - shape_;
    normal_.diagonal().segment<4>(2).array() += keep;
    right.segment<4>(2) += keep * Eigen::Vector4d(back(0, 0), back(0, 1), back(1, 0), back(1, 1));
    const Vector8 change = normal_.ldlt().solve(right);
    if (!change.allFinite()) return false;
    centre_ += change.head<2>();
    shape_ += (Eigen::Matrix2d() << change(2), change(3), change(4), change(5)).finished();
    contrast_ += change(6);
    brightness_ += change(7);
    step_px = change.head<2>().norm();
    return (centre_ - start_).norm() < kFarthestFit_px && contrast_ > 0.2 && contrast_ < 5.0;
  }

  std::vector<Pixel> pixels_;
  const cv::Mat1f& other_;
  Eigen::Vector2d start_;
  Eigen::Matrix2d first_shape_;
  Eigen::Vector2d centre_;
  Eigen::Matrix2d shape_;
  double contrast_ = 1.0, brightness_ = 0.0;
  Matrix8 normal_ = Matrix8::Zero();
  double mean_square_ = 0.0;
};

}  // namespace

std::optional<PatchFit> fit_patch(const cv::Mat1f& image, const Eigen::Vector2d& px, double slope,
                                  const cv::Mat1f& other, const Eigen::Vector2d& start,
                                  const Eigen::Matrix2d& shape) {
  auto pixels = pixels_of(image, px, slope);
  if (!pixels) return std::nullopt;
  Adjustment adjustment(std::move(*pixels), other, start, shape);
  if (!adjustment.settle()) return std::nullopt;
  return adjustment.fit();
}

Eigen::Vector2d deciding_offset(const cv::Mat1f& image, const Eigen::Vector2d& px, double slope) {
  constexpr double kWeightSd_px = 0.7 * kHalf;
  const auto change = [&](int i, int j) {
    const double x = px.x() + i, y = px.y() + j + slope * i;
    const float step = sample(image, x + 1.0, y + slope) - sample(image, x - 1.0, y - slope);
    return static_cast<double>(step * step);
  };
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  double most = 0.0;
  for (int j = -kPatchHalf; j <= kPatchHalf; ++j) {
    for (int i = -kPatchHalf; i <= kPatchHalf; ++i) {
      // Three rows together: less noise.
      const double sum = change(i, j - 1) + change(i, j) + change(i, j + 1);
      const double weighted =
          sum * std::exp(-0.5 * (i * i + j * j) / (kWeightSd_px * kWeightSd_px));
      if (!(weighted > most)) continue;  // NaN beside the picture
      most = weighted;
      best = {i, j};
    }
  }
  return best;
}

}  // namespace ols::scenery
