// Finds the sun's centre in a picture taken through a filter, by fitting a circle to the sun's
// limb. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct SunDisc {
  enum class Refusal {
    kNone,
    kNoDisc,     // nothing bright in front of something dark, or several discs
    kAtTheEdge,  // the disc is at the edge of the picture
    kOtherSize,  // not the sun, or another focal length
    kNotRound,   // clouds, or too long an exposure
  };
  Refusal refusal = Refusal::kNoDisc;
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double radius_px = 0.0;
  double sd_px = 0.0;  // 1-sigma of each coordinate of the centre
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(SunDisc::Refusal refusal);

// `focal_px` gives the expected radius to within 3 % (the sun's distance changes it by 1.7 %).
SunDisc find_sun(const cv::Mat& gray, double focal_px);

// Whether neither sky nor scenery is visible, which means that a solar filter is on the lens.
bool is_black(const cv::Mat& gray);

}  // namespace ols::calibration
