#include "edge/detector/clutter_map.h"

#include <algorithm>
#include <cmath>

namespace ols::detector {
namespace {

// The prior of a tile weighs as much as one second of images.
constexpr double kPriorImages = 30.0;
constexpr double kPriorDetections = 0.6;
constexpr double kPriorSeconds = 1.0;
constexpr double kPriorStarts = 0.1;
constexpr double kMemory_s = 30.0;

}  // namespace

ClutterMap::ClutterMap(const cv::Size& image)
    : image_(image),
      tiles_(kColumns * kRows, {kPriorDetections, kPriorStarts}),
      images_(kPriorImages),
      seconds_(kPriorSeconds) {}

void ClutterMap::next_image(double interval_s) {
  const double kept = std::exp(-interval_s / kMemory_s);
  for (Tile& tile : tiles_) {
    // What is forgotten is replaced by the prior.
    tile.detections = kept * tile.detections + (1.0 - kept) * kPriorDetections;
    tile.starts = kept * tile.starts + (1.0 - kept) * kPriorStarts;
  }
  images_ = kept * images_ + (1.0 - kept) * kPriorImages + 1.0;
  seconds_ = kept * seconds_ + (1.0 - kept) * kPriorSeconds + interval_s;
}

std::size_t ClutterMap::tile(const Eigen::Vector2d& pixel) const {
  const int column =
      std::clamp(static_cast<int>(pixel.x() * kColumns / image_.width), 0, kColumns - 1);
  const int row = std::clamp(static_cast<int>(pixel.y() * kRows / image_.height), 0, kRows - 1);
  return static_cast<std::size_t>(row * kColumns + column);
}

void ClutterMap::add_detection(const Eigen::Vector2d& pixel) {
  tiles_[tile(pixel)].detections += 1.0;
}
void ClutterMap::add_start(const Eigen::Vector2d& pixel) { tiles_[tile(pixel)].starts += 1.0; }

double ClutterMap::density(const Eigen::Vector2d& pixel) const {
  const double area_px2 = static_cast<double>(image_.area()) / (kColumns * kRows);
  return tiles_[tile(pixel)].detections / images_ / area_px2;
}

double ClutterMap::starts_an_hour(const Eigen::Vector2d& pixel) const {
  return 3600.0 * tiles_[tile(pixel)].starts / seconds_;
}

}  // namespace ols::detector
