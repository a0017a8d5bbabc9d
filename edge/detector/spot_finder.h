// Finds compact spots of either polarity before smooth surroundings in a single image: a target
// before the sky, however slowly it moves.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/detector/detection.h"

namespace ols::detector {

struct SpotConfig {
  double threshold_sd = 5.0;  // of the peak, in standard deviations of the ring around it
  double least_levels = 2.0;  // [grey levels] minimum peak
  double most_clutter = 0.5;  // of the ring's deviations (their 95 %), as a part of the peak
  int levels = 5;             // of the pyramid: each finds spots of twice the size
  std::size_t most = 60;      // maximum number, strongest first
};

// The ring's own spread sets the threshold of each place (order-statistic constant false alarm
// rate): a branch, a text, an edge of a cloud has its like around it, a target has not. A bright
// target does not raise the threshold of its neighbour, because the order statistics ignore it.
class SpotFinder {
 public:
  explicit SpotFinder(const SpotConfig& config) : config_(config) {}

  // `gray`: 8-bit, one channel.
  std::vector<Detection> find(const cv::Mat& gray);

 private:
  void find_in(const cv::Mat& gray, const cv::Mat& level, int reduction,
               std::vector<Detection>& spots);
  std::optional<Detection> spot_at(const cv::Mat& gray, const cv::Mat& level, const cv::Point& at,
                                   int reduction) const;
  bool exceeds_surroundings(const cv::Point& at) const;
  void residual(const cv::Mat& level);
  void measure_surroundings();

  SpotConfig config_;
  cv::Mat small_sum_, inner_sum_, outer_sum_;  // of boxes of 3, 7 and 13 pixels
  cv::Mat residual_, greatest_;                // [1/16 grey level] magnitude; its maximum nearby
  cv::Mat usual_;  // the residual's median by tile, the largest of a tile and its neighbours
};

}  // namespace ols::detector
