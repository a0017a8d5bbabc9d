// Reads the ruler of a rectification target. The ruler has black and white bars of equal height on
// a vertical board. One black bar, which is three times as high, marks the zero. Pure.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::calibration {

struct RulerReading {
  enum class Refusal {
    kNone,
    kNothing,  // no bars found
    kScale,    // the height of the bars does not match the distance
    kNoZero,   // the zero bar is hidden or outside the picture
    kShort,    // the ruler does not reach the requested row
    kUneven,   // the bars are not equal: half hidden, blurred, or no ruler
  };
  Refusal refusal = Refusal::kNone;
  double scale = 1.0;  // found height of a bar over the expected height
  double x_px = 0.0;   // column of the ruler
  // The reading at the requested row, counted from the middle of the zero bar, in units of a bar's
  // height.
  double bars = 0.0;
  double sd_px = 0.0;    // 1-sigma of the reading, as a distance in the picture
  double zero_px = 0.0;  // row of the middle of the zero bar
  explicit operator bool() const { return refusal == Refusal::kNone; }
};
const char* to_string(RulerReading::Refusal refusal);

// Finds a point on a ruler whose bars have this height; nullopt if there is no ruler.
std::optional<Eigen::Vector2d> find_ruler(const cv::Mat& gray, double bar_px);

// Reads the ruler that contains the point `at_px`, at the row `row_px`. `bar_px`: expected height
// of a bar.
RulerReading read_ruler(const cv::Mat& gray, const Eigen::Vector2d& at_px, double bar_px,
                        double row_px);

}  // namespace ols::calibration
