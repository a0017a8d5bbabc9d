#include "edge/command/slew_search.h"

#include <algorithm>
#include <cmath>

#include "conditions/alarms.h"
#include "edge/tracker/object_at.h"

namespace ols::station {

void SlewSearch::restart(bool found) {
  acquisition_.clear();
  if (found) in_view_ = {};
  searched_s_ = kNever;  // at the first frame of a search the tracker is sent a hint
}

namespace {

constexpr double kCompared_s = 1.0;  // pictures older than that show another scene

// Of a line through a pixel, where it passes nearest to the middle of the picture.
Eigen::Vector2d nearest_to_middle(const Eigen::Vector2d& pixel, const Eigen::Vector2d& line,
                                  const CameraIntrinsics& camera) {
  const Eigen::Vector2d middle(camera.cx_px, camera.cy_px);
  return pixel + (middle - pixel).dot(line) * line;
}

}  // namespace

// Straight lines are straight in the picture, but for its distortion, which is small where the lens
// is long.
std::optional<SlewSearch::Expected> SlewSearch::expected(const camera::Frame& frame,
                                                         const PointingModel& pointing,
                                                         const Slew& slew) {
  const auto angles = pointing.angles_at(frame.mid_exposure_s);
  if (!slew || !angles) return std::nullopt;
  const AzimuthElevation direction = direction_at(*slew, frame.mid_exposure_s);
  const auto pixel = pointing.pixel_of(angles->angles, direction);
  if (!pixel) return std::nullopt;
  if (!slew->searches_line()) return Expected{*pixel, angles->angles};
  constexpr double kStep_rad = 0.01;
  const auto further = pointing.pixel_of(
      angles->angles,
      {direction.azimuth_rad + kStep_rad * slew->line.x() / std::cos(direction.elevation_rad),
       direction.elevation_rad + kStep_rad * slew->line.y()});
  if (!further) return std::nullopt;
  const Eigen::Vector2d line = (*further - *pixel).normalized();
  return Expected{nearest_to_middle(*pixel, line, pointing.geometry().camera), angles->angles,
                  line};
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
  if (!where) return false;
  const Eigen::Vector2d off = output.pixel - where->pixel;
  const Eigen::Vector2d beside = off - off.dot(where->line) * where->line;
  return beside.norm() <= kSigmas * search_sd_px(pointing, *slew);
}

std::optional<SlewSearch::Place> SlewSearch::send_tracker(const camera::Frame& frame,
                                                          const PointingModel& pointing,
                                                          const Slew& slew) {
  if (frame.mid_exposure_s - searched_s_ <= config_.search_interval_s) return std::nullopt;
  const auto where = expected_in_picture(frame, pointing, slew);
  if (!where) return std::nullopt;
  searched_s_ = frame.mid_exposure_s;
  const bool anywhere = slew->searches_line();
  return Place{where->pixel, anywhere ? max_search_sd_px(config_) : search_sd_px(pointing, *slew)};
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

// It is where the slew leads, and moves as the slew does. Along a line nobody knows how the target
// moves: then it must move at all.
bool SlewSearch::behaves(const detector::Tracklet& tracklet, const camera::Frame& frame,
                         const PointingModel& pointing, const Slew& slew) const {
  constexpr double kSigmas = 4.0, kMoment_s = 0.1;
  constexpr double kRateOff_px_s = 50.0;  // of the slew's rate: the fusion's is some moments old
  const auto where = expected(frame, pointing, slew);
  if (!where || !tracklet.seen()) return false;
  const Eigen::Vector2d off = tracklet.measured_pixel() - where->pixel;
  const Eigen::Vector2d beside = off - off.dot(where->line) * where->line;
  if (beside.norm() > kSigmas * search_sd_px(pointing, *slew)) return false;
  if (slew->searches_line()) return tracklet.way_px() >= config_.acquisition.place_px;
  const auto next =
      pointing.pixel_of(where->angles, direction_at(*slew, frame.mid_exposure_s + kMoment_s));
  if (!next) return false;
  const Eigen::Vector2d rate_off = tracklet.velocity_px_s() - (*next - where->pixel) / kMoment_s;
  return rate_off.norm() <= std::hypot(kSigmas * tracklet.velocity_sd_px_s(), kRateOff_px_s);
}

// The tracker begins in the detector's picture, with the object's outline there.
std::optional<SlewSearch::Acquired> SlewSearch::choose(const std::deque<camera::Frame>& frames,
                                                       const detector::Found& found,
                                                       const PointingModel& pointing,
                                                       const Slew& slew) const {
  constexpr double kFresh_s = 0.5, kPadding = 0.2;
  const auto frame =
      std::ranges::find(frames, found.mid_exposure_s, &camera::Frame::mid_exposure_s);
  if (frame == frames.end() || frames.back().mid_exposure_s - found.mid_exposure_s > kFresh_s) {
    return std::nullopt;
  }
  const detector::Tracklet* only = nullptr;
  for (const detector::Tracklet& tracklet : found.confirmed) {
    if (!behaves(tracklet, *frame, pointing, slew)) continue;
    if (only != nullptr) return std::nullopt;
    only = &tracklet;
  }
  if (only == nullptr) return std::nullopt;
  if (const auto outline = tracker::object_at(frame->gray, only->measured_pixel())) {
    return Acquired{&*frame, *outline, true};
  }
  const Eigen::Vector2d side = (1.0 + kPadding) * only->size_px().array() + 2.0;
  const Eigen::Vector2d corner = only->measured_pixel().array() + 0.5 - 0.5 * side.array();
  return Acquired{&*frame, {corner.x(), corner.y(), side.x(), side.y()}, true};
}

std::optional<SlewSearch::Acquired> SlewSearch::acquire(const std::deque<camera::Frame>& frames,
                                                        const std::optional<detector::Found>& found,
                                                        const PointingModel& pointing,
                                                        const Slew& slew) {
  if (found) {
    if (const auto chosen = choose(frames, *found, pointing, slew)) return chosen;
  }
  const auto box = look(frames, pointing, slew);
  return box ? std::optional(Acquired{&frames.back(), *box}) : std::nullopt;
}

std::optional<cv::Rect2d> SlewSearch::look(const std::deque<camera::Frame>& frames,
                                           const PointingModel& pointing, const Slew& slew) {
  const camera::Frame& frame = frames.back();
  const auto now = expected_in_picture(frame, pointing, slew);
  if (!now) {
    acquisition_.clear();
    return std::nullopt;
  }
  tracker::AcquisitionView view;
  view.gray = frame.gray;
  view.expected_px = now->pixel;
  view.expected_sd_px = search_sd_px(pointing, *slew);
  view.line = now->line;
  // Along another station's line of sight nobody knows how the target moves: 15 m/s at 250 m.
  constexpr double kUnknownRate_rad_s = 0.06;
  if (slew->searches_line() && frames.size() > 1) {
    const double since_s = frame.mid_exposure_s - frames[frames.size() - 2].mid_exposure_s;
    view.drift_px = kUnknownRate_rad_s * pointing.geometry().camera.fx_px * since_s;
  }
  for (auto earlier = frames.rbegin() + 1; earlier != frames.rend(); ++earlier) {
    if (frame.mid_exposure_s - earlier->mid_exposure_s > kCompared_s) break;
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

void SlewSearch::begin_trial(const Acquired& target) {
  searched_s_ = target.frame->mid_exposure_s;
  acquisition_.clear();
  if (target.by_tracklet) counters_["acquisitions_by_tracklet"] += 1;
}

void SlewSearch::end_trial(double time_s) {
  searched_s_ = kNever;
  in_view_.own_from_s = time_s;
}

Alarm SlewSearch::unacquired_alarm(const Slew& slew) const {
  const double waited_s = in_view_.to_s - in_view_.from_s;
  if (!slew || slew->searches_line() || waited_s < config_.unacquired_alarm_s) return {};
  const double sd_px = slew->direction_sd_rad * config_.geometry.camera.fx_px;
  if (sd_px > max_search_sd_px(config_)) return {};
  return alarm::target_not_acquired(waited_s);
}

}  // namespace ols::station
