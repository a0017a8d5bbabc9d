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
  // Float, smoothed; square with an odd side, so that the point is the middle pixel.
  cv::Mat pixels;
};

// Cuts the patch around a point; nullopt if it does not fit into the picture. `turn` maps the
// patch's coordinates to those of the picture to be searched, in case that picture shows the
// surroundings turned or sheared.
std::optional<Patch> cut_patch(const cv::Mat& gray, const Eigen::Vector2d& centre_px, int half_px,
                               const Eigen::Matrix2d& turn = Eigen::Matrix2d::Identity());

struct PatchMatch {
  enum class Refusal {
    kNone,
    kOutside,      // the point is outside the picture
    kNoStructure,  // the patch is a uniform surface, or an edge along which it could slide
    kNotFound,     // no similar place
    kAmbiguous,    // two places are almost equally similar
  };
  Refusal refusal = Refusal::kNone;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;        // 1-sigma of the less exact coordinate
  double correlation = 0.0;  // 0..1, at the position found
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(PatchMatch::Refusal refusal);

// Searches within `reach_px` of a point, in each coordinate.
PatchMatch find_patch(const Patch& patch, const cv::Mat& gray, const Eigen::Vector2d& near_px,
                      double reach_px);

}  // namespace ols::calibration
