// Notices a camera that is frozen: no picture is new to the last bit. An encoder makes the same few
// pictures of a frozen image again and again, one for each place between two key frames. Pure.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <unordered_set>

namespace ols::camera {

class PictureChange {
 public:
  // For how long there was no new picture.
  double unchanged_s(const cv::Mat& gray, double arrival_s);

 private:
  std::unordered_set<std::size_t> seen_;
  double since_s_ = 0.0;
};

}  // namespace ols::camera
