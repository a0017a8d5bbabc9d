// Reads a rectification target's ruler: black and white bars of equal height on a vertical board.
// One black bar of three times the height is the zero. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::calibration {

struct RulerReading {
  enum class Refusal {
    kNone,
    kNothing,  // no bars
    kScale,    // the bars' height does not match the distance
    kNoZero,   // the zero is hidden or outside the picture
    kShort,    // the ruler does not reach the wanted row
    kUneven,   // the bars are not even: half hidden, blurred, or no ruler
  };
  Refusal refusal = Refusal::kNone;
  double scale = 1.0;    // height of a bar over the expected one
  double x_px = 0.0;     // column of the ruler
  double bars = 0.0;     // the reading at the wanted row, from the zero's middle, in units of a
                         // bar's height
  double sd_px = 0.0;    // 1-sigma of the reading's position
  double zero_px = 0.0;  // row of the zero's middle
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(RulerReading::Refusal refusal);

// A point on a ruler whose bars have this height; nullopt if there is none.
std::optional<Eigen::Vector2d> find_ruler(const cv::Mat& gray, double bar_px);

// Reads the ruler at `at_px`, at this row. `bar_px`: expected height of a bar.
RulerReading read_ruler(const cv::Mat& gray, const Eigen::Vector2d& at_px, double bar_px,
                        double row_px);

}  // namespace ols::calibration
