#include "calibration/pictures/mirrored_blend.h"

namespace ols::calibration {

cv::Mat mirrored_blend(const cv::Mat& gray) {
  cv::Mat mirrored, blend;
  cv::flip(gray, mirrored, 1);
  cv::addWeighted(gray, 0.5, mirrored, 0.5, 0.0, blend);
  return blend;
}

}  // namespace ols::calibration
