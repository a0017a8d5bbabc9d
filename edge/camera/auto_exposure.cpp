#include "edge/camera/auto_exposure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ols::camera {
namespace {

constexpr int kStride = 4;            // every 16th pixel of the whole image is enough
constexpr double kSaturated = 250.0;  // from this gray level on a camera saturates
constexpr double kManySaturated = 0.02;
constexpr double kQuantile = 0.95;
constexpr int kLeast_px = 9;  // minimum number of pixels

struct Histogram {
  std::array<int, 256> counts{};
  int total = 0;

  void add(std::uint8_t level) {
    ++counts[level];
    ++total;
  }
  double quantile(double share) const {
    int sum = 0;
    for (std::size_t level = 0; level < counts.size(); ++level) {
      sum += counts[level];
      if (sum >= share * total) return static_cast<double>(level);
    }
    return 255.0;
  }
  double mean() const {
    double sum = 0.0;
    for (std::size_t level = 0; level < counts.size(); ++level)
      sum += static_cast<double>(level) * counts[level];
    return total > 0 ? sum / total : 0.0;
  }
  double saturated() const {
    int sum = 0;
    for (auto level = static_cast<std::size_t>(kSaturated); level < counts.size(); ++level)
      sum += counts[level];
    return total > 0 ? static_cast<double>(sum) / total : 0.0;
  }
};

cv::Rect clipped(const cv::Rect2d& box, const cv::Mat& gray) {
  const cv::Rect2d all(0.0, 0.0, gray.cols, gray.rows);
  const cv::Rect2d inside = box & all;
  return cv::Rect(cvFloor(inside.x), cvFloor(inside.y), cvCeil(inside.width),
                  cvCeil(inside.height)) &
         cv::Rect(0, 0, gray.cols, gray.rows);
}

double light(const ExposureSetting& s) { return s.exposure_us * std::pow(10.0, s.gain_dB / 20.0); }

PictureLevels of_whole(const cv::Mat& gray) {
  Histogram all;
  for (int y = 0; y < gray.rows; y += kStride)
    for (int x = 0; x < gray.cols; x += kStride) all.add(gray.at<std::uint8_t>(y, x));
  return {.target = false,
          .mean = all.mean(),
          .bright = all.quantile(kQuantile),
          .saturated = all.saturated()};
}

}  // namespace

PictureLevels measure_levels(const cv::Mat& gray, const std::optional<cv::Rect2d>& target_box) {
  if (!target_box) return of_whole(gray);
  const cv::Rect box = clipped(*target_box, gray);
  const cv::Rect around =
      clipped({target_box->x - target_box->width, target_box->y - target_box->height,
               3.0 * target_box->width, 3.0 * target_box->height},
              gray);
  Histogram target, surround;
  for (int y = around.y; y < around.y + around.height; ++y)
    for (int x = around.x; x < around.x + around.width; ++x)
      (box.contains({x, y}) ? target : surround).add(gray.at<std::uint8_t>(y, x));
  if (target.total < kLeast_px || surround.total < kLeast_px) return of_whole(gray);
  return {.target = true,
          .mean = surround.mean(),
          .bright = std::max(target.quantile(kQuantile), surround.quantile(kQuantile)),
          .saturated = std::max(target.saturated(), surround.saturated())};
}

AutoExposure::AutoExposure(const AutoExposureConfig& config, const ExposureLimits& limits,
                           const ExposureSetting& start)
    : config_(config), limits_(limits), setting_(start), since_change_(config.settle_frames) {}

// The factor of light that brings the levels to their goals.
double AutoExposure::wanted_factor(const PictureLevels& levels) const {
  // Saturated pixels do not show by how much they exceed the range.
  if (levels.saturated > kManySaturated) return 1.0 / config_.greatest_factor;
  const double to_bright = config_.bright_level / std::max(levels.bright, 1.0);
  if (levels.target) return to_bright;
  return std::min(config_.mean_level / std::max(levels.mean, 1.0), to_bright);
}

ExposureSetting AutoExposure::split(double wanted) const {
  const double least_gain = std::pow(10.0, limits_.gain_min_dB / 20.0);
  const double exposure_us =
      std::clamp(wanted / least_gain, limits_.exposure_min_us, limits_.exposure_max_us);
  const double gain_dB =
      std::clamp(20.0 * std::log10(wanted / exposure_us), limits_.gain_min_dB, limits_.gain_max_dB);
  return {.exposure_us = exposure_us, .gain_dB = gain_dB};
}

std::optional<ExposureSetting> AutoExposure::step(const PictureLevels& levels) {
  if (++since_change_ <= config_.settle_frames) return std::nullopt;
  const double error = std::log(wanted_factor(levels));
  if (std::abs(error) <= config_.dead_band) {
    missing_ = 1.0;
    return std::nullopt;
  }
  const double greatest = std::log(config_.greatest_factor);
  const double change = std::exp(std::clamp(config_.damping * error, -greatest, greatest));
  const ExposureSetting next = split(light(setting_) * change);
  const double possible = light(next) / light(setting_);
  missing_ =
      std::abs(std::log(change / possible)) > config_.dead_band ? std::exp(error) / possible : 1.0;
  if (std::abs(std::log(possible)) < 0.01) return std::nullopt;
  since_change_ = 0;
  return next;
}

}  // namespace ols::camera
