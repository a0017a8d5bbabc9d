// Least-squares matching (A. Gruen, Adaptive Least Squares Correlation, 1985): finds the structure
// that a small patch shows in another picture, to a fraction of a pixel. Pure.
//
// A coarse search by normalised correlation comes first, then least squares for translation, gain
// and offset.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::calibration {

struct Patch {
  // Float, smoothed; a square with an odd side. The middle pixel is the point.
  cv::Mat pixels;
};

// Cuts the patch around a point; nullopt if the patch is not entirely inside the picture. The patch
// is resampled to the orientation of the picture that will be searched: `turn` maps offsets in that
// picture to offsets in `gray`. Use the identity unless one picture shows the scenery turned or
// sheared relative to the other.
std::optional<Patch> cut_patch(const cv::Mat& gray, const Eigen::Vector2d& centre_px, int half_px,
                               const Eigen::Matrix2d& turn = Eigen::Matrix2d::Identity());

struct PatchMatch {
  enum class Refusal {
    kNone,
    kOutside,      // the point is outside the picture
    kNoStructure,  // the patch shows a uniform surface, or one edge along which it could slide
    kNotFound,     // no place is similar
    kAmbiguous,    // two places are almost equally similar
  };
  Refusal refusal = Refusal::kNone;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;        // 1-sigma of the less exact coordinate
  double correlation = 0.0;  // 0..1, at the position found
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(PatchMatch::Refusal refusal);

// Searches for the patch within `reach_px` of a point, in each coordinate.
PatchMatch find_patch(const Patch& patch, const cv::Mat& gray, const Eigen::Vector2d& near_px,
                      double reach_px);

}  // namespace ols::calibration
