// Finds compact spots, brighter or darker than a smooth background, in a single image. A target in
// front of the sky is such a spot, even if it does not move.
#pragma once

#include <algorithm>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/detector/box_residual.h"
#include "edge/detector/detection.h"
#include "edge/detector/tile_medians.h"

namespace ols::detector {

struct SpotConfig {
  double threshold_sd = 5.0;  // minimum peak, in standard deviations of the ring around it
  double least_levels = 2.0;  // [grey levels] minimum peak
  double most_clutter = 0.5;  // maximum deviation in the ring (95 % quantile), relative to the peak
  int levels = 5;  // number of pyramid levels; each finds spots twice as large as the one before
  std::size_t most = 60;  // maximum number of spots; the strongest come first
};

// The threshold at each place follows from the spread of grey levels in the ring around it
// (order-statistic constant false alarm rate). The ring around a part of a branch, a text or a
// cloud's edge contains further parts of it, which raise the threshold; the ring around a target
// does not. A bright target does not raise the threshold for its neighbour, because order
// statistics ignore outliers.
class SpotFinder {
 public:
  explicit SpotFinder(const SpotConfig& config)
      : config_(config), reduced_(static_cast<std::size_t>(std::max(1, config.levels) - 1)) {}

  // `gray`: 8-bit, one channel.
  std::vector<Detection> find(const cv::Mat& gray);

 private:
  void find_in(const cv::Mat& gray, const cv::Mat& level, int reduction,
               std::vector<Detection>& spots);
  void find_peaks(int column, int row);
  std::optional<Detection> spot_at(const cv::Mat& gray, const cv::Mat& level, const cv::Point& at,
                                   int reduction);
  bool exceeds_surroundings(const cv::Point& at);

  SpotConfig config_;
  std::vector<cv::Mat> reduced_;  // all levels of the pyramid except the image itself
  BoxResidual residual_;          // residual of the level that is searched
  TileMedians usual_;             // medians of the residual
  std::vector<cv::Point> peaks_;  // peaks of one tile
};

}  // namespace ols::detector
