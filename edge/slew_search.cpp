#include "edge/slew_search.h"

#include <algorithm>
#include <cstdio>

namespace ols::station {

void SlewSearch::restart(bool found) {
  acquisition_.clear();
  if (found) in_view_ = {};
  searched_s_ = kNever;  // at the first frame of a search the tracker is sent a hint
}

std::optional<SlewSearch::Expected> SlewSearch::expected(const camera::Frame& frame,
                                                         const PointingModel& pointing,
                                                         const Slew& slew) {
  const auto angles = pointing.angles_at(frame.mid_exposure_s);
  if (!slew || !angles) return std::nullopt;
  const auto pixel = pointing.pixel_of(angles->angles, direction_at(*slew, frame.mid_exposure_s));
  if (!pixel) return std::nullopt;
  return Expected{*pixel, angles->angles};
}

std::optional<SlewSearch::Expected> SlewSearch::expected_in_picture(const camera::Frame& frame,
                                                                    const PointingModel& pointing,
                                                                    const Slew& slew) {
  const auto where = expected(frame, pointing, slew);
  return where && pointing.in_picture(where->pixel) ? where : std::nullopt;
}

// The fusion's uncertainty of the target, and this station's of its own directions.
double SlewSearch::search_sd_px(const PointingModel& pointing, const SlewCommand& slew) const {
  const CalibrationSd& own = pointing.geometry().sd;
  const double sd_rad =
      Eigen::Vector4d(slew.direction_sd_rad, own.heading_rad, own.tilt_rad, own.mount_rad).norm();
  return std::clamp(sd_rad * config_.geometry.camera.fx_px, config_.search_sd_px,
                    max_search_sd_px(config_));
}

bool SlewSearch::is_where_slewed(const camera::Frame& frame, const tracker::TrackerOutput& output,
                                 const PointingModel& pointing, const Slew& slew) const {
  constexpr double kSigmas = 4.0;
  const auto where = expected(frame, pointing, slew);
  return where && (output.pixel - where->pixel).norm() <= kSigmas * search_sd_px(pointing, *slew);
}

std::optional<SlewSearch::Place> SlewSearch::send_tracker(const camera::Frame& frame,
                                                          const PointingModel& pointing,
                                                          const Slew& slew) {
  if (frame.mid_exposure_s - searched_s_ <= config_.search_interval_s) return std::nullopt;
  const auto where = expected_in_picture(frame, pointing, slew);
  if (!where) return std::nullopt;
  searched_s_ = frame.mid_exposure_s;
  return Place{where->pixel, search_sd_px(pointing, *slew)};
}

// Gaps are bridged: a lost frame, a late slew, a search step that leads out of the image.
void SlewSearch::note_in_view(const camera::Frame& frame, const PointingModel& pointing,
                              const Slew& slew) {
  constexpr double kGap_s = 3.0;
  if (!expected_in_picture(frame, pointing, slew)) return;
  const double time_s = frame.mid_exposure_s;
  if (time_s - in_view_.to_s > kGap_s) in_view_ = {time_s, time_s, time_s};
  in_view_.to_s = time_s;
}

bool SlewSearch::looks_for_anything(const FollowedTarget& target) const {
  if (!config_.acquire_by_slew) return false;
  if (!target.exists()) return true;
  return !target.on_trial() && in_view_.to_s - in_view_.own_from_s > config_.own_target_s;
}

std::optional<cv::Rect2d> SlewSearch::acquire(const std::deque<camera::Frame>& frames,
                                              const PointingModel& pointing, const Slew& slew) {
  const camera::Frame& frame = frames.back();
  const auto now = expected_in_picture(frame, pointing, slew);
  if (!now) {
    acquisition_.clear();
    return std::nullopt;
  }
  tracker::AcquisitionView view{frame.gray, now->pixel, search_sd_px(pointing, *slew), {}};
  for (auto earlier = frames.rbegin() + 1; earlier != frames.rend(); ++earlier) {
    const auto then = expected(*earlier, pointing, slew);
    if (!then) continue;
    const Eigen::Matrix3d homography =
        rotation_homography(pointing.geometry(), then->angles, now->angles);
    const Eigen::Vector3d moved = homography * then->pixel.homogeneous();
    view.references.push_back({earlier->gray, homography, moved.hnormalized()});
  }
  const auto box = acquisition_.look(view);
  counters_["acquisition_candidates"] += static_cast<double>(acquisition_.candidates().size());
  if (box) acquisition_.clear();
  return box;
}

void SlewSearch::end_trial(double time_s) {
  searched_s_ = kNever;
  in_view_.own_from_s = time_s;
}

std::string SlewSearch::unacquired_alarm(const Slew& slew) const {
  const double waited_s = in_view_.to_s - in_view_.from_s;
  if (!slew || waited_s < config_.unacquired_alarm_s) return {};
  const double sd_px = slew->direction_sd_rad * config_.geometry.camera.fx_px;
  if (sd_px > max_search_sd_px(config_)) return {};
  char text[120];
  std::snprintf(text, sizeof text,
                "target: slewed for %.0f s with its place in the image, nothing acquired: "
                "designate it",
                waited_s);
  return text;
}

}  // namespace ols::station
