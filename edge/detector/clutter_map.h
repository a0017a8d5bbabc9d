// Learns how often each part of the image shows clutter: detections that are not targets.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::detector {

// Counts detections, and tracklets that begin, in each tile of the image. The counts decay with a
// time constant of half a minute. Detections of confirmed tracklets must not be added; otherwise,
// an object would raise its own threshold.
class ClutterMap {
 public:
  explicit ClutterMap(const cv::Size& image);

  void next_image(double interval_s);
  void add_detection(const Eigen::Vector2d& pixel);
  void add_start(const Eigen::Vector2d& pixel);

  // [1/px^2] Expected number of clutter detections in one image.
  double density(const Eigen::Vector2d& pixel) const;
  // Number of tracklets per hour that begin in the tile of this pixel.
  double starts_an_hour(const Eigen::Vector2d& pixel) const;
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;

 private:
  struct Tile {
    double detections, starts;  // decaying sums
  };
  std::size_t tile(const Eigen::Vector2d& pixel) const;

  cv::Size image_;
  std::vector<Tile> tiles_;
  double images_, seconds_;  // decaying sums
};

}  // namespace ols::detector
