// Finds moving points that are too dim for a single image, by shift and stack against an even
// background.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/detector/binned_residual.h"
#include "edge/detector/detection.h"
#include "edge/detector/line_sum.h"
#include "edge/detector/residual_past.h"
#include "edge/detector/stack_tile.h"
#include "edge/detector/velocity_stack.h"

namespace ols::detector {

struct DimConfig {
  // Thresholds in standard deviations of a sum: of a peak of the shift and stack (eight images),
  // which is then examined more closely; of the sum along the best line through sixteen images; of
  // every eight images after these.
  double peak_sd = 4.6, line_sd = 6.2, next_sd = 3.6;
  double least_px = 0.6;  // speed relative to the scene, per image: slower ones are taken for scene
  std::size_t tiles = 8;  // largest number that is stacked with one image
  std::size_t most = 16;  // number of points that are followed
};

// A point that the stack shows is followed on its straight path, and measured once in eight images
// from these images alone, so that the noise of its detections is independent. If no part of the
// picture is even, the search rests for a while, because the ground seldom becomes sky.
class DimFinder {
 public:
  explicit DimFinder(const DimConfig& config) : config_(config) {}

  // `gray`: 8-bit, one channel. `motion` maps the previous image's pixels to this image's; nullopt:
  // unknown, and the scene is taken to be at rest in the image. Returns what was measured in this
  // image. Begins anew after a pause of a second.
  std::vector<Detection> find(const cv::Mat& gray, double time_s,
                              const std::optional<Eigen::Matrix3d>& motion);
  // Begins anew, because the scene changed at once.
  void clear();

 private:
  struct Point {
    Eigen::Vector2d pixel, velocity_px;  // in the newest image, and per image relative to the scene
    double signal_to_noise;              // of the newest eight images' sum
    bool brighter;
    long id = 0;         // 0: not followed yet
    int unmeasured = 0;  // images since it was measured or missed
    int misses = 0;      // in succession
  };
  void remember(const cv::Mat& gray, double time_s, const std::optional<Eigen::Matrix3d>& motion);
  void follow(std::vector<Detection>& found);
  bool measure(Point& point) const;
  void search(std::vector<Detection>& found);
  void stack_next_tile();
  void take_peaks(const cv::Point& corner);
  Point point_at(const cv::Point& peak, const cv::Point& corner, bool brighter, double unit) const;
  bool confirm(Point& point) const;
  static bool is_alone(const LineSum& line, const Point& point, double sum);
  bool is_followed(const Eigen::Vector2d& pixel) const;
  bool is_inside(const Eigen::Vector2d& pixel) const;
  Detection detection(const Point& point) const;

  DimConfig config_;
  BinnedResidual residual_;
  ResidualPast past_;
  std::vector<double> times_s_;  // of the past's images, newest last
  StackTile tile_;
  VelocityStack stack_;
  std::vector<Point> peaks_;  // of the tile that is being searched
  std::vector<Point> followed_;
  std::size_t next_tile_ = 0;
  std::size_t uneven_ = 0;  // tiles since the last even one
  int rest_ = 0;            // images to leave out
  long next_id_ = 1;
};

}  // namespace ols::detector
