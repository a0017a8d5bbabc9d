// Compares a station's pictures with the skyline of the land, one picture after the other. Pure,
// but slow: a picture takes some tens of milliseconds, the first one seconds.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "conditions/alarm.h"
#include "edge/skyline/seen_horizon.h"
#include "edge/skyline/skyline_heading.h"
#include "edge/video/video_frame.h"
#include "land/horizon_map.h"
#include "land/surface.h"

namespace ols::skyline {

class SkylineWatch {
 public:
  explicit SkylineWatch(std::shared_ptr<const land::Surface> surface,
                        const land::HorizonMapConfig& config = {})
      : surface_(std::move(surface)), config_(config) {}

  // A picture with the pose that the station states for it. If the camera has been moved, all
  // earlier pictures are forgotten.
  void look(const cv::Mat& gray, const video::CameraView& camera);
  // Call it when the station's heading or reference has changed.
  void forget();

  // nullopt while too little of the skyline has been seen.
  const std::optional<SkylineHeading>& heading() const { return heading_; }
  // The heading is wrong, or the land does not fit the station; empty if neither.
  Alarm alarm() const;

  static constexpr double kMoved_m = 5.0;

 private:
  bool has_map(const Geodetic& camera);

  std::shared_ptr<const land::Surface> surface_;
  land::HorizonMapConfig config_;
  std::optional<Geodetic> place_;  // of the map, also if the land does not fit there
  std::optional<land::HorizonMap> map_;
  std::string why_none_;
  double place_sd_m_ = 0.0;
  SeenHorizon seen_;
  std::optional<SkylineHeading> heading_;
  bool disagrees_ = false;
};

}  // namespace ols::skyline
