// The crosses of a rectification target: upright, dark arms on a light board, alone or two side by
// side. Found at the size that their distance gives, by normalised correlation with a drawn one;
// placed where the middle lines of the two arms cross. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

// As it should appear in the picture [px].
struct CrossSize {
  double arm_px = 0.0;    // from the centre to the end of an arm
  double width_px = 0.0;  // of an arm
  double apart_px = 0.0;  // of the two crosses; 0: there is one
};

struct Crosses {
  enum class Refusal {
    kNone,
    kNothing,  // no cross stands out
    kOne,      // one, where two are expected
    kScale,    // they appear larger or smaller than the distance allows
    kBlurred,  // placed to no better than a third of a pixel
  };
  Refusal refusal = Refusal::kNone;
  double scale = 1.0;                                 // their size over the expected one
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero();  // of one alone: the same
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of a coordinate of the right one
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(Crosses::Refusal refusal);

Crosses find_crosses(const cv::Mat& gray, const CrossSize& expected);

}  // namespace ols::calibration
