#include "edge/detector/line_sum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::detector {
namespace {

constexpr double kMost = 4.0;  // standard deviations of one image
// To interpolate averages the noise of neighbouring bins. The scene, a mean of nine images, adds
// noise of its own.
constexpr double kInterpolated = 1.2, kWithoutScene = 1.13;

// Of the bins around a pixel, from the median of their magnitudes.
double noise_near(const cv::Mat& residual, const Eigen::Vector2d& pixel) {
  constexpr int kReach = 18, kStep = 3;  // [bins]
  constexpr double kSdOfMedian = 1.4826;
  const cv::Point at(static_cast<int>(pixel.x() / 2.0), static_cast<int>(pixel.y() / 2.0));
  std::vector<std::int16_t> sample;
  for (int y = std::max(0, at.y - kReach); y <= std::min(residual.rows - 1, at.y + kReach);
       y += kStep) {
    const auto* row = residual.ptr<std::int16_t>(y);
    for (int x = std::max(0, at.x - kReach); x <= std::min(residual.cols - 1, at.x + kReach);
         x += kStep)
      sample.push_back(static_cast<std::int16_t>(std::abs(row[x])));
  }
  if (sample.empty()) return 1.0;
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return std::max(1.0, kSdOfMedian * *middle);
}

}  // namespace

LineSum::LineSum(const ResidualPast& past, const Eigen::Vector2d& near_by)
    : past_(&past), noise_(noise_near(past.residual(0), near_by)) {
  for (std::size_t age = 0; age < shifts_px_.size(); ++age)
    shifts_px_.at(age) = past.shift_px(age, near_by);
}

std::optional<double> LineSum::value(std::size_t age, const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d bin = ((pixel + shifts_px_.at(age)).array() - 0.5) / 2.0;
  const cv::Mat& residual = past_->residual(age);
  const int x = static_cast<int>(std::floor(bin.x())), y = static_cast<int>(std::floor(bin.y()));
  if (x < 0 || y < 0 || x + 1 >= residual.cols || y + 1 >= residual.rows) return std::nullopt;
  const auto* upper = residual.ptr<std::int16_t>(y) + x;
  const auto* lower = residual.ptr<std::int16_t>(y + 1) + x;
  const double right = bin.x() - x, down = bin.y() - y;
  const double above = upper[0] + right * (upper[1] - upper[0]);
  const double below = lower[0] + right * (lower[1] - lower[0]);
  return above + down * (below - above);
}

double LineSum::along(const Eigen::Vector2d& pixel, const Eigen::Vector2d& velocity_px,
                      std::size_t images) const {
  const double most = kMost * noise_;
  double sum = 0.0;
  for (std::size_t age = 0; age < images; ++age) {
    const Eigen::Vector2d at = pixel - static_cast<double>(age) * velocity_px;
    sum += std::clamp(value(age, at).value_or(0.0), -most, most);
  }
  return kInterpolated * sum / noise_ / std::sqrt(static_cast<double>(images));
}

// At the same place of the scene in the nine images that are most distant in time, as if the oldest
// were followed by the newest.
std::optional<double> LineSum::scene(std::size_t age, const Eigen::Vector2d& pixel) const {
  constexpr std::size_t kNearest = 4;
  const double most = 3.0 * kMost * noise_;
  double sum = 0.0;
  int count = 0;
  for (std::size_t later = kNearest; later <= ResidualPast::kImages - kNearest; ++later) {
    const auto level = value((age + later) % ResidualPast::kImages, pixel);
    if (!level) continue;
    sum += std::clamp(*level, -most, most);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

double LineSum::along_without_scene(const Eigen::Vector2d& pixel,
                                    const Eigen::Vector2d& velocity_px, std::size_t images) const {
  const double most = kMost * noise_;
  double sum = 0.0;
  for (std::size_t age = 0; age < images; ++age) {
    const Eigen::Vector2d at = pixel - static_cast<double>(age) * velocity_px;
    const auto level = value(age, at), usual = scene(age, at);
    if (level && usual) sum += std::clamp(*level - *usual, -most, most);
  }
  return kWithoutScene * sum / noise_ / std::sqrt(static_cast<double>(images));
}

double LineSum::along_without_texture(const Eigen::Vector2d& pixel,
                                      const Eigen::Vector2d& velocity_px,
                                      std::size_t images) const {
  constexpr int kReach = 6;          // paths to each side: where the noise is measured, too
  constexpr double kApart_px = 6.0;  // beyond the matched filter, so that each has its own noise
  // On nearer ones, the point itself is a part of the scene that is subtracted.
  constexpr double kAside_px = 9.0;
  const Eigen::Vector2d across = Eigen::Vector2d(-velocity_px.y(), velocity_px.x()).normalized();
  const double last = static_cast<double>(images - 1);
  const auto is_inside = [&](const Eigen::Vector2d& newest) {
    return value(0, newest) && value(images - 1, newest - last * velocity_px);
  };
  double squares = 0.0;
  int count = 0;
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      const Eigen::Vector2d off = kApart_px * Eigen::Vector2d(x, y);
      if (std::abs(off.dot(across)) < kAside_px || !is_inside(pixel + off)) continue;
      const double sum = along_without_scene(pixel + off, velocity_px, images);
      squares += sum * sum;
      ++count;
    }
  }
  constexpr double kWhite = 1.2;  // in white noise they spread less
  const double spread = std::sqrt(squares / std::max(1, count));
  return along_without_scene(pixel, velocity_px, images) / (spread < kWhite ? 1.0 : spread);
}

}  // namespace ols::detector
