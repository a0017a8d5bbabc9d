// Detects a frozen camera: one that sends pictures without any new content. Comparing with the last
// picture is not enough: the camera's encoder codes a frozen image differently at each position
// between two key frames, and repeats these few pictures. Pure.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <unordered_set>

namespace ols::camera {

class PictureChange {
 public:
  // Takes a picture. Returns the time [s] since the last picture that differed from all recent
  // ones.
  double unchanged_s(const cv::Mat& gray, double arrival_s);

 private:
  std::unordered_set<std::size_t> seen_;
  double since_s_ = 0.0;
};

}  // namespace ols::camera
