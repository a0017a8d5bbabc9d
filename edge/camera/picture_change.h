// Notices a frozen camera, whose pictures have no new pixels. The encoder turns a frozen image into
// the same few pictures again and again, one for each position between two key frames. Pure.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <unordered_set>

namespace ols::camera {

class PictureChange {
 public:
  // Takes a picture. Returns the time since the last picture with new pixels [s].
  double unchanged_s(const cv::Mat& gray, double arrival_s);

 private:
  std::unordered_set<std::size_t> seen_;
  double since_s_ = 0.0;
};

}  // namespace ols::camera
