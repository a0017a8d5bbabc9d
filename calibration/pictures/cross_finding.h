// Finds the crosses of a rectification target: one, or two side by side. Each is upright, with dark
// arms on a light board. The search correlates the picture with a drawn cross of the expected size
// (normalised correlation). The position of a cross is the intersection of the middle lines of its
// two bars. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace ols::calibration {

// The expected size of the crosses in the picture [px].
struct CrossSize {
  double arm_px = 0.0;    // from the centre to the end of an arm
  double width_px = 0.0;  // width of an arm
  double apart_px = 0.0;  // distance between the two crosses; 0 if there is only one
};

struct Crosses {
  enum class Refusal {
    kNone,
    kNothing,  // no cross stands out
    kOne,      // one cross where two are expected
    kScale,    // larger or smaller than the distance allows
    kBlurred,  // the position is less exact than a third of a pixel
  };
  Refusal refusal = Refusal::kNone;
  double scale = 1.0;  // found size over expected size
  Eigen::Vector2d left_px =
      Eigen::Vector2d::Zero();  // equal to the right one if there is only one cross
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();
  double sd_px = 0.0;  // 1-sigma of each coordinate of the right cross
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(Crosses::Refusal refusal);

Crosses find_crosses(const cv::Mat& gray, const CrossSize& expected);

}  // namespace ols::calibration
