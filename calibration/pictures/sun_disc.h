// Finds the sun's centre in a picture taken through a filter, by fitting a circle to the sun's
// limb. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

struct SunDisc {
  enum class Refusal {
    kNone,
    kNoDisc,     // no bright disc on a dark background, or several
    kAtTheEdge,  // the disc is at the border of the picture
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

// `focal_px`: the focal length. It determines the expected radius; the found radius may differ by 3
// % (the changing distance of the sun causes 1.7 %).
SunDisc find_sun(const cv::Mat& gray, double focal_px);

// Whether neither sky nor scenery is visible: a solar filter is then on the lens.
bool is_black(const cv::Mat& gray);

}  // namespace ols::calibration
