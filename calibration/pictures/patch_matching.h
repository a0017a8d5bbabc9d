// Least-squares matching (A. Gruen, Adaptive Least Squares Correlation, 1985): finds the structure
// of a small patch in another picture, to a fraction of a pixel. Pure.
//
// A coarse search by normalised correlation comes first, then least squares for translation, gain
// and offset.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::calibration {

struct Patch {
  cv::Mat pixels;  // float, smoothed; square with an odd side: the middle is the point
};

// The patch around a point; nullopt if it does not fit into the picture. `turn` converts the
// patch's coordinates to those of the searched picture; it is not the identity if that picture
// shows the surroundings turned or sheared.
std::optional<Patch> cut_patch(const cv::Mat& gray, const Eigen::Vector2d& centre_px, int half_px,
                               const Eigen::Matrix2d& turn = Eigen::Matrix2d::Identity());

struct PatchMatch {
  enum class Refusal {
    kNone,
    kOutside,      // of the picture
    kNoStructure,  // the patch is a plain surface, or an edge along which it slides
    kNotFound,     // nothing similar
    kAmbiguous,    // two places are nearly alike
  };
  Refusal refusal = Refusal::kNone;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;        // 1-sigma of the worse coordinate
  double correlation = 0.0;  // 0..1, at the found place
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(PatchMatch::Refusal refusal);

// Searches within `reach_px` of a point, in each coordinate.
PatchMatch find_patch(const Patch& patch, const cv::Mat& gray, const Eigen::Vector2d& near_px,
                      double reach_px);

}  // namespace ols::calibration
