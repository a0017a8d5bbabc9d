// Compares a station's pictures with the skyline of the land, one picture after the other. A
// picture takes some tens of milliseconds. The first picture at a new place takes seconds, because
// the map of the horizon is computed for that place. Pure.
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
  // 1-sigma of its azimuths and elevations, from the errors of heading, tilt, mounting, angles and
  // lens. These errors may be the same in all pictures.
  double azimuth_sd_rad = 0.0, elevation_sd_rad = 0.0;
  Eigen::Vector3d position_sd_enu_m = Eigen::Vector3d::Zero();
  std::int64_t utime_us = 0;  // UTC of the exposure
};

// The skyline that a station has seen from one place and with one setup, as far as it hides
// targets.
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

  // Processes a picture; call it in the order of the pictures' times. If the camera has moved by
  // more than kMoved_m, all earlier pictures are forgotten.
  void look(const StatedPicture& picture);
  // Forgets all pictures. Call it when the station's heading or reference has changed or is in
  // doubt.
  void forget();

  // nullopt while too little of the skyline has been seen.
  const std::optional<SkylineHeading>& heading() const { return heading_; }
  // 1-sigma of the difference between the heading according to the skyline and the heading that the
  // station states.
  double difference_sd_rad() const;
  bool disagrees() const { return disagrees_; }
  // As heading(), but from the wider search, and with nothing known of the camera's height above
  // the land; nullopt while too little of the skyline has been seen.
  const std::optional<SkylineHeading>& height() const { return height_; }
  // Each column of the skyline as it was seen last; empty before anything is seen. A column that
  // disagrees with the land is included only after several pictures have confirmed it: at least
  // kPictures, taken over at least kApart_s, with elevations that agree to within kSame_rad. It is
  // removed when a picture shows the land there, or when it has not been seen for kKept_s.
  const HidingSkyline& hiding() const { return hiding_; }
  // Continues `earlier`, a saved skyline, as soon as a picture is taken at the place from which
  // that skyline was seen.
  void resume(HidingSkyline earlier) { earlier_ = std::move(earlier); }

  // The alarm that the heading is wrong, or that the land does not fit the station's position or
  // height; empty otherwise.
  Alarm alarm() const;

  static constexpr double kMoved_m = 5.0;
  // While the land does not fit, a new map is tried as soon as the stated position has changed by
  // this distance, because the first position fix may have been wrong.
  static constexpr double kAgain_m = 0.5;
  // For hiding(): the edge of a cloud moves by more than kSame_rad within kApart_s, and therefore
  // does not count as an obstacle.
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
  void compare_height(const StatedPicture& newest);
  void note_obstacles(const StatedPicture& picture, const PictureView& view, const Rows& expected);
  void take(const SeenPlace& place, const land::SeenCrest& crest, const StatedPicture& picture);
  void remove_old(double now_s);

  std::shared_ptr<const land::Surface> surface_;
  land::HorizonMapConfig config_;
  // The stated place for which the map was made or, if there is no map, tried last.
  std::optional<Eigen::Vector3d> place_ecef_;
  std::optional<land::HorizonMap> map_;
  std::string why_none_;
  double model_sd_m_ = 0.0;  // 1-sigma of a shift of the whole model of the land
  SeenHorizon seen_;
  // Like seen_, but from a search farther from the map's skyline.
  SeenHorizon obstacles_{kSame_rad};
  HidingSkyline hiding_;
  // When each column that disagrees with the land was last seen.
  std::map<int, double> disagreed_s_;
  std::optional<HidingSkyline> earlier_;
  std::optional<SkylineHeading> heading_, height_;
  double stated_height_sd_m_ = 0.0;  // of the camera above the land, when `height_` was computed
  double stated_sd_rad_ = 0.0;  // stated 1-sigma of the azimuths from which `heading_` was computed
  bool disagrees_ = false, height_disagrees_ = false;
};

}  // namespace ols::skyline
