// Compares a station's pictures with the skyline of the land, one picture after the other. Pure,
// but slow: a picture takes some tens of milliseconds, the first one seconds.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "conditions/alarm.h"
#include "edge/skyline/seen_horizon.h"
#include "edge/skyline/skyline_heading.h"
#include "edge/video/video_frame.h"
#include "land/horizon_map.h"
#include "land/seen_skyline.h"
#include "land/surface.h"

namespace ols::skyline {

// A picture of a camera at rest, and what the station states about it.
struct StatedPicture {
  double mid_exposure_s = 0.0;  // on the station's monotonic clock
  cv::Mat gray;                 // 8-bit, one channel
  video::CameraView camera;
  // 1-sigma of its azimuths and elevations from heading, tilt, mounting, angles and lens; these
  // errors may be the same in all pictures.
  double azimuth_sd_rad = 0.0, elevation_sd_rad = 0.0;
  Eigen::Vector3d position_sd_enu_m = Eigen::Vector3d::Zero();
  std::int64_t utime_us = 0;  // of the exposure, UTC
};

// What hides targets from a station: the skyline that it has seen, from one place and with one
// setup.
struct HidingSkyline {
  std::int64_t begun_us = 0;  // UTC of the first picture; distinguishes one skyline from the next
  Eigen::Vector3d camera_ecef = Eigen::Vector3d::Zero();
  land::SeenSkyline crests;
};

class SkylineWatch {
 public:
  explicit SkylineWatch(std::shared_ptr<const land::Surface> surface,
                        const land::HorizonMapConfig& config = {})
      : surface_(std::move(surface)), config_(config) {}

  // Pictures in order of their times. If the camera has been moved, all earlier pictures are
  // forgotten.
  void look(const StatedPicture& picture);
  // Call it when the station's heading or reference has changed or is in doubt.
  void forget();

  // nullopt while too little of the skyline has been seen.
  const std::optional<SkylineHeading>& heading() const { return heading_; }
  // 1-sigma of the difference between the heading that the skyline shows and the heading that the
  // station states.
  double difference_sd_rad() const;
  bool disagrees() const { return disagrees_; }
  // Each column as it was seen last; empty before anything is seen. A column that disagrees with
  // the land counts only once kPictures have shown it at the same elevation over kApart_s. It
  // counts until a picture shows the land there, or for kKept_s.
  const HidingSkyline& hiding() const { return hiding_; }
  // Continues an earlier skyline as soon as a picture is taken at the place where it was seen.
  void resume(HidingSkyline earlier) { earlier_ = std::move(earlier); }

  // The heading is wrong, or the land does not fit the station; empty if neither.
  Alarm alarm() const;

  static constexpr double kMoved_m = 5.0;
  // While the land does not fit, a new place is tried sooner, because the first fix may have been
  // wrong.
  static constexpr double kAgain_m = 0.5;
  // The edge of a cloud moves within kApart_s.
  static constexpr int kPictures = 3;
  static constexpr double kApart_s = 120.0, kSame_rad = radians(0.2);
  static constexpr double kKept_s = 86'400.0;

 private:
  void clear();
  bool has_map(const StatedPicture& picture);
  void resume_earlier(const StatedPicture& picture);
  Geodetic camera_of_map(const Geodetic& stated, double height_sd_m) const;
  Eigen::Vector3d place_sd_enu_m(const StatedPicture& picture) const;
  void compare(const StatedPicture& newest);
  void note_obstacles(const StatedPicture& picture, const PictureView& view, const Rows& expected);
  void take(const SeenPlace& place, const land::SeenCrest& crest, const StatedPicture& picture);
  void remove_old(double now_s);

  std::shared_ptr<const land::Surface> surface_;
  land::HorizonMapConfig config_;
  // The stated place for which the map was made or, without a map, tried last.
  std::optional<Eigen::Vector3d> place_ecef_;
  std::optional<land::HorizonMap> map_;
  std::string why_none_;
  double model_sd_m_ = 0.0;  // of the model as a whole
  SeenHorizon seen_;
  SeenHorizon obstacles_{kSame_rad};  // as above, but searched farther from the map's skyline
  HidingSkyline hiding_;
  std::map<int, double> disagreed_s_;  // when the columns that disagree were seen last
  std::optional<HidingSkyline> earlier_;
  std::optional<SkylineHeading> heading_;
  double stated_sd_rad_ = 0.0;  // of the azimuths from which `heading_` comes
  bool disagrees_ = false;
};

}  // namespace ols::skyline
