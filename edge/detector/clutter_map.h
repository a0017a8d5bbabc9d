// Learns how often each part of the image shows clutter: detections that are not targets.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::detector {

// Counts detections and tentative tracklets in each tile of the image. The counts fade over half a
// minute. Confirmed objects do not count, so that an object does not raise its own threshold.
class ClutterMap {
 public:
  explicit ClutterMap(const cv::Size& image);

  void next_image(double interval_s);
  void add_detection(const Eigen::Vector2d& pixel);
  void add_start(const Eigen::Vector2d& pixel);

  // Expected number of unexplained detections in an image [1/px^2].
  double density(const Eigen::Vector2d& pixel) const;
  // Number of tracklets per hour that begin in the tile.
  double starts_an_hour(const Eigen::Vector2d& pixel) const;
  static constexpr int kColumns = 8;
  static constexpr int kRows = 6;

 private:
  struct Tile {
    double detections, starts;  // fading sums
  };
  std::size_t tile(const Eigen::Vector2d& pixel) const;

  cv::Size image_;
  std::vector<Tile> tiles_;
  double images_, seconds_;  // fading sums
};

}  // namespace ols::detector
