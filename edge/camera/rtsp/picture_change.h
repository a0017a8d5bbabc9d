// Notices a picture that stays the same to the last bit: a frozen camera. Pure.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::camera {

class PictureChange {
 public:
  // For how long the picture has been the same.
  double unchanged_s(const cv::Mat& gray, double arrival_s);

 private:
  std::optional<std::uint64_t> print_;
  double since_s_ = 0.0;
};

}  // namespace ols::camera
