// Where and how a slewed station looks for its target: with the template of an earlier track, or
// for anything that behaves as the slew says.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "edge/station.h"

namespace ols {
namespace {

// The pixel of a direction at infinity.
std::optional<Eigen::Vector2d> pixel_of(const StationGeometry& geometry, const PanTilt& angles,
                                        const AzimuthElevation& direction) {
  constexpr double kFar_m = 1e6;
  const Eigen::Vector3d centre = camera_centre_ecef(geometry, angles);
  const Eigen::Vector3d point =
      centre + kFar_m * (R_ecef_enu(centre) * enu_from_azimuth_elevation(direction));
  const auto seen = view(geometry, angles, point);
  if (!seen) return std::nullopt;
  return seen->pixel;
}

bool in_picture(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera.width_px &&
         pixel.y() <= camera.height_px;
}

}  // namespace

std::optional<Station::Expected> Station::expected(const Frame& frame) const {
  const auto angles = history_.at(frame.mid_exposure_s);
  if (!slew_ || !angles) return std::nullopt;
  const auto pixel =
      pixel_of(config_.geometry, angles->angles, direction_at(*slew_, frame.mid_exposure_s));
  if (!pixel) return std::nullopt;
  return Expected{*pixel, angles->angles};
}

// What the fusion does not know of the target, and this station of its own directions.
double Station::search_sd_px() const {
  const CalibrationSd& own = config_.geometry.sd;
  const double sd_rad =
      Eigen::Vector4d(slew_->direction_sd_rad, own.heading_rad, own.tilt_rad, own.mount_rad).norm();
  return std::clamp(sd_rad * config_.geometry.camera.fx_px, config_.search_sd_px,
                    config_.search_sd_most_px());
}

// What looks like the target elsewhere is not the one that the others see there.
bool Station::is_where_slewed(const Frame& frame, const TrackerOutput& output) const {
  constexpr double kSigmas = 4.0;
  const auto where = expected(frame);
  return where && (output.pixel - where->pixel).norm() <= kSigmas * search_sd_px();
}

void Station::search_along_slew() {
  if (frames_.empty()) return;
  const auto where = expected(frames_.back());
  // The PTU is still on its way: no use in searching yet.
  if (!where || !in_picture(config_.geometry.camera, where->pixel)) return;
  tracker_->search_near(where->pixel, search_sd_px());
  searched_s_ = frames_.back().mid_exposure_s;
}

// Gaps are bridged: a lost frame, a late slew, a step of a search that leads out of the picture.
void Station::note_in_view(const Frame& frame) {
  constexpr double kGap_s = 3.0;
  if (state_ != StationState::kSlewed) return;
  const auto where = expected(frame);
  if (!where || !in_picture(config_.geometry.camera, where->pixel)) return;
  const double time_s = frame.mid_exposure_s;
  if (time_s - in_view_.to_s > kGap_s) in_view_ = {time_s, time_s, time_s};
  in_view_.to_s = time_s;
}

// A slewed station that has not found its own target for own_target_s where the slews lead looks
// for whatever is there, as one without a target does: what it was told to follow may never have
// been the target.
bool Station::looks_for_anything() const {
  if (!config_.acquire_by_slew || state_ != StationState::kSlewed) return false;
  if (template_ == Template::kNone) return true;
  return template_ != Template::kUnproven &&
         in_view_.to_s - in_view_.own_from_s > config_.own_target_s;
}

// In words, of a slew to a place that is known well enough to be in the picture.
std::string Station::slewed_in_vain() const {
  const double waited_s = in_view_.to_s - in_view_.from_s;
  if (state_ != StationState::kSlewed || !slew_ || waited_s < config_.unacquired_alarm_s) return {};
  const double sd_px = slew_->direction_sd_rad * config_.geometry.camera.fx_px;
  if (sd_px > config_.search_sd_most_px()) return {};
  char text[120];
  std::snprintf(text, sizeof text,
                "target: slewed for %.0f s with its place in the picture, nothing acquired: "
                "designate it",
                waited_s);
  return text;
}

void Station::acquire(const Frame& frame) {
  const auto now = expected(frame);
  if (!now || !in_picture(config_.geometry.camera, now->pixel)) return acquisition_.clear();
  AcquisitionView view{frame.gray, now->pixel, search_sd_px(), {}};
  for (auto earlier = frames_.rbegin() + 1; earlier != frames_.rend(); ++earlier) {
    const auto then = expected(*earlier);
    if (!then) continue;
    const Eigen::Matrix3d homography =
        rotation_homography(config_.geometry, then->angles, now->angles);
    const Eigen::Vector3d moved = homography * then->pixel.homogeneous();
    view.references.push_back({earlier->gray, homography, moved.hnormalized()});
  }
  const auto box = acquisition_.look(view);
  counters_["acquisition_candidates"] += static_cast<double>(acquisition_.candidates().size());
  if (box) take(frame, *box);
}

void Station::take(const Frame& frame, const cv::Rect2d& box) {
  acquisition_.clear();
  const bool has_own = template_ != Template::kNone;
  if (has_own) tracker_->set_aside();
  if (tracker_->initialise({frame.gray, frame.mid_exposure_s, std::nullopt}, box)) {
    if (has_own) tracker_->take_back();
    return;
  }
  if (has_own) own_ = OwnTarget{template_, track_id_, tracked_s_};
  track_id_ = ++last_track_id_;
  template_ = Template::kUnproven;
  tracked_s_ = searched_s_ = acquired_s_ = frame.mid_exposure_s;
  last_output_.reset();
  believed_in_a_row_ = 0;
  counters_["acquisitions"] += 1;
}

void Station::drop_unproven(double time_s) {
  constexpr double kTrial_s = 1.0;
  if (template_ != Template::kUnproven || time_s - acquired_s_ < kTrial_s) return;
  counters_["acquisitions_dropped"] += 1;
  if (own_) return take_back_own(time_s);
  template_ = Template::kNone;
  if (state_ == StationState::kLost) enter(StationState::kIdle);
}

// What was found instead was not believed in: the own target has its turn again.
void Station::take_back_own(double time_s) {
  tracker_->take_back();
  template_ = own_->kind;
  track_id_ = own_->track_id;
  tracked_s_ = own_->tracked_s;
  own_.reset();
  last_output_.reset();
  believed_in_a_row_ = 0;
  searched_s_ = InView::kNever;
  in_view_.own_from_s = time_s;
}

}  // namespace ols
