// Finds the parallel, nearly level lines of a rectification target, each to a fraction of a pixel.
// Pure.
//
// A Radon transform sums the gradient along all nearly level lines, and finds them through noise
// and gaps. Each edge is then fitted to its centroids, column by column. Hidden parts are left out.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::calibration {

// One edge, by two points. They are one radius of gyration to either side of its middle, so that
// their errors across the line are independent, and a line that the lens bends evenly passes
// through both.
struct LevelEdge {
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero(), right_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // across the line, of each point
};

struct LevelLines {
  enum class Refusal {
    kNone,
    kNothing,  // no line stands out
    kShort,    // none longer than a quarter of the picture's width
    kSteep,    // rolled by more than eight degrees
    kBlurred,  // edges wider than forty pixels
  };
  Refusal refusal = Refusal::kNone;
  std::vector<LevelEdge> edges;  // from top to bottom
  double slope = 0.0;            // mean of the edges; positive down to the right
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(LevelLines::Refusal refusal);

LevelLines find_level_lines(const cv::Mat& gray);

}  // namespace ols::calibration
