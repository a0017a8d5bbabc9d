// Recognises confirmed objects by their appearance in images in which they were not detected. Such
// an object may have slowed down, stand still, or be too similar to what is behind it.
#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/detector/tracklet.h"
#include "edge/tracker/learnt_appearance.h"

namespace ols::detector {

class AppearanceBook {
 public:
  // `gray`: 8-bit, one channel; the image that the following calls are about. It is not modified.
  void next_image(const cv::Mat& gray, double time_s);
  // Where the object is near its predicted place; nullopt if it is not recognised there.
  std::optional<Eigen::Vector2d> find(const Tracklet& tracklet);
  // Learns the appearance of the confirmed objects that are seen in this image, at most eight, and
  // forgets that of all others that are not confirmed any more.
  void learn(const std::vector<Tracklet>& tracklets);

 private:
  struct Known {
    tracker::LearntAppearance appearance;
    double learnt_s;  // time of the newest image that it was learnt from
  };
  void learn(Known& known, const Tracklet& tracklet) const;

  tracker::TrackerInput image_;
  std::map<long, Known> known_;  // by the tracklet's id
};

}  // namespace ols::detector
