// Finds moving points that are too dim for a single image. It sums images that are shifted along
// each of many velocities (shift and stack). This needs a uniform background.
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
  // Thresholds, in standard deviations of a sum. peak_sd: for a peak of the shift and stack over
  // eight images, which is then examined more closely. line_sd: for the sum along the best straight
  // path through sixteen images. next_sd: for each later sum of eight images.
  double peak_sd = 4.6, line_sd = 6.2, next_sd = 3.6;
  // Least speed relative to the scene, per image; slower points belong to the scene.
  double least_px = 0.6;
  std::size_t tiles = 8;  // maximum number of tiles that are searched with each image
  std::size_t most = 16;  // maximum number of points that are followed
};

// A point that the stack shows is followed along its straight path. It is measured once in eight
// images, from these eight alone, so that the noise of successive measurements is independent. If
// no part of the picture is uniform, the search pauses for 60 images, because the ground seldom
// becomes sky.
class DimFinder {
 public:
  explicit DimFinder(const DimConfig& config) : config_(config) {}

  // `gray`: 8-bit, one channel. `motion` maps the previous image's pixels to this image's. If it is
  // nullopt (unknown), the scene is assumed to be at rest in the image. Returns the points that
  // were measured with this image. The search begins anew if the previous image is more than a
  // second old.
  std::vector<Detection> find(const cv::Mat& gray, double time_s,
                              const std::optional<Eigen::Matrix3d>& motion);
  // Begins anew; call it if the whole scene has changed at once.
  void clear();

 private:
  struct Point {
    Eigen::Vector2d pixel, velocity_px;  // in the newest image; per image, relative to the scene
    double signal_to_noise;              // of the sum of the newest eight images
    bool brighter;
    long id = 0;         // 0: not followed yet
    int unmeasured = 0;  // number of images since the last attempt to measure it
    int misses = 0;      // number of consecutive misses
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
  std::vector<double> times_s_;  // times of the images in past_, newest last
  StackTile tile_;
  VelocityStack stack_;
  std::vector<Point> peaks_;  // peaks of the tiles that are searched with this image
  std::vector<Point> followed_;
  std::size_t next_tile_ = 0;
  std::size_t uneven_ = 0;  // number of tiles searched since the last uniform one
  int rest_ = 0;            // number of images that are still to be skipped
  long next_id_ = 1;
};

}  // namespace ols::detector
