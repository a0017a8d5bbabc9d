// Finds flying or moving objects in a camera's images, without a designation. It uses neither
// clocks nor files.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/detector/appearance_book.h"
#include "edge/detector/dim_finder.h"
#include "edge/detector/mover_finder.h"
#include "edge/detector/spot_finder.h"
#include "edge/detector/tracklet_book.h"
#include "edge/tracker/ego_motion.h"

namespace ols::detector {

struct DetectorConfig {
  SpotConfig spots;
  MoverConfig movers;
  DimConfig dim;
  TrackletConfig tracklets;
};

class Detector {
 public:
  Detector(const DetectorConfig& config, const cv::Size& image);

  struct Result {
    std::vector<Detection> detections;  // of this image alone
    // True if the whole image changed at once. Then, neither movers nor dim points were searched
    // for.
    bool suspended = false;
    std::optional<tracker::ImageMotion> motion;  // from the previous image; nullopt without texture
  };
  // `gray`: 8-bit, one channel, always of the same size. `predicted`: the motion of the scene in
  // the image according to the mount's angles. It maps the previous image's pixels to this image's.
  // The detector refines it by means of the images.
  Result advance(const cv::Mat& gray, double time_s,
                 const std::optional<Eigen::Matrix3d>& predicted, const Stars& stars = {});

  const std::vector<Tracklet>& tracklets() const { return book_.tracklets(); }
  long suspended_images() const { return suspended_images_; }

 private:
  std::optional<tracker::ImageMotion> measure_motion(
      const tracker::ReducedFrame& frame, const std::optional<Eigen::Matrix3d>& predicted);

  tracker::EgoMotionEstimator ego_motion_;
  SpotFinder spots_;
  MoverFinder movers_;
  DimFinder dim_;
  TrackletBook book_;
  AppearanceBook appearances_;
  std::optional<double> time_s_;  // of the newest image
  long suspended_images_ = 0;
};

}  // namespace ols::detector
