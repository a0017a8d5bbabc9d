// Finds the parallel, nearly level lines of a rectification target, with an accuracy of a fraction
// of a pixel. Pure.
//
// A Radon transform sums the gradient along all nearly level lines. It finds lines in spite of
// noise and gaps. Then the centroid of each edge is computed in each column, and a line is fitted
// to the centroids. Hidden parts of an edge are left out.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace ols::calibration {

// One edge, represented by two points: one radius of gyration to the left of the edge's middle, and
// one to the right. At this distance, the errors of the two points across the line are independent.
// If the lens bends the line evenly, the bent line still passes through both points.
struct LevelEdge {
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero(), right_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of each point, across the line
};

struct LevelLines {
  enum class Refusal {
    kNone,
    kNothing,  // no line stands out
    kShort,    // no line is longer than a quarter of the picture's width
    kSteep,    // the lines are rolled by more than eight degrees
    kBlurred,  // the edges are wider than forty pixels
  };
  Refusal refusal = Refusal::kNone;
  std::vector<LevelEdge> edges;  // from top to bottom
  double slope = 0.0;            // mean over the edges; positive if they fall to the right
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(LevelLines::Refusal refusal);

LevelLines find_level_lines(const cv::Mat& gray);

}  // namespace ols::calibration
