#include "edge/station/detected_objects.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ols::station {
namespace {

// Pixel centres are whole numbers; a box begins at a pixel's edge.
Eigen::Vector2d centre_px(const cv::Rect2d& box) {
  return {box.x + 0.5 * box.width - 0.5, box.y + 0.5 * box.height - 0.5};
}

bool is_in(const cv::Rect2d& box, const detector::Tracklet& tracklet) {
  constexpr double kMargin_px = 3.0;
  const Eigen::Vector2d off = (tracklet.measured_pixel() - centre_px(box)).cwiseAbs();
  const Eigen::Vector2d sides = Eigen::Vector2d(box.width, box.height).cwiseMax(tracklet.size_px());
  return (off.array() < 0.5 * sides.array() + kMargin_px).all();
}

// By the sequential test. Among tracklets at its upper limit, the one followed longest wins, so
// that the choice does not change from image to image.
bool is_likelier(const detector::Tracklet* a, const detector::Tracklet* b) {
  return std::pair(a->log_ratio(), a->age_s()) > std::pair(b->log_ratio(), b->age_s());
}

}  // namespace

void DetectedObjects::on_frame(const camera::Frame& frame,
                               const std::optional<FollowedBox>& followed, double now_s) {
  constexpr double kEarly = 0.25;  // share of a period, for the frames' own jitter
  if (!config_.enabled) return;
  const double period_s = 1.0 / config_.rate_hz;
  const double mid_s = frame.mid_exposure_s;
  const bool is_due = mid_s >= due_s_ - kEarly * period_s;
  // At this rate on average, without catching up after a pause.
  if (is_due) due_s_ = (mid_s > due_s_ + period_s ? mid_s : due_s_) + period_s;
  if (is_due && waiting_) counters_["detector_images_dropped"] += 1;
  // While the detector is busy, a newer frame replaces the waiting one.
  if (is_due || (waiting_ && looks_)) waiting_ = Look{frame, followed, now_s};
}

std::optional<detector::Picture> DetectedObjects::take(const PointingModel& pointing, double now_s,
                                                       bool stars_show) {
  if (!waiting_ || looks_) return std::nullopt;
  const double mid_s = waiting_->frame.mid_exposure_s;
  const auto angles = pointing.angles_at(mid_s);
  const bool bracketed = angles && angles->interpolated;
  if (!bracketed && now_s - waiting_->arrived_s < angle_wait_s_) return std::nullopt;
  looks_ = std::exchange(waiting_, std::nullopt);
  detector::Picture picture{looks_->frame.gray, mid_s, std::nullopt};
  if (looked_s_) picture.motion = pointing.homography(*looked_s_, mid_s);
  picture.stars.show = stars_show;
  if (looked_s_ && stars_show) picture.stars.motion = pointing.star_motion(*looked_s_, mid_s);
  looked_s_ = mid_s;
  return picture;
}

std::int64_t DetectedObjects::track_id(long tracklet,
                                       const std::function<std::int64_t()>& new_track_id) {
  const auto [known, is_new] = track_ids_.try_emplace(tracklet, 0);
  if (is_new) {
    known->second = new_track_id();
    counters_["tracklets"] += 1;
  }
  return known->second;
}

namespace {

DetectedPixel outline_of(const detector::Tracklet& tracklet) {
  constexpr double kBlur_px = 2.0, kOutline = 0.25;  // fixed and relative part of the error
  const auto& outline = tracklet.outline();
  const Eigen::Vector2d sides_px = outline ? outline->size_px : tracklet.measured_size_px();
  Eigen::Index larger = 0;
  const double size_px = sides_px.maxCoeff(&larger);
  return {.size_px = size_px,
          .size_sd_px = std::hypot(kBlur_px, kOutline * size_px),
          .across_px = sides_px.minCoeff(),
          .size_noise_px = outline ? outline->sd_px(larger) : 0.0,
          .signal = tracklet.signal_to_noise()};
}

}  // namespace

// If the target shows in several parts, the largest counts.
void DetectedObjects::note_followed(const Look& look) {
  of_followed_.reset();
  if (!look.followed) return;
  followed_id_ = look.followed->track_id;
  for (const detector::Tracklet& tracklet : newest_->confirmed) {
    if (!tracklet.seen() || !is_in(look.followed->box, tracklet)) continue;
    DetectedPixel part = outline_of(tracklet);
    part.is_tracklet = false;
    if (!of_followed_ || part.size_px > of_followed_->size_px) of_followed_ = part;
  }
}

std::optional<DetectedPixel> DetectedObjects::take_detection_of(std::int64_t track_id) {
  if (track_id != followed_id_) return std::nullopt;
  return std::exchange(of_followed_, std::nullopt);
}

PixelMeasurement DetectedObjects::measured(const detector::Tracklet& tracklet,
                                           const Look& look) const {
  constexpr double kCentring = 0.1;  // by the size: only the visible part's centre is measured
  PixelMeasurement pixel;
  pixel.stamp_sd_s = look.frame.stamp_sd_s;
  pixel.stamp_source = look.frame.stamp_source;
  pixel.pixel = tracklet.measured_pixel();
  pixel.mid_exposure_s = camera::row_time_s(look.frame, pixel.pixel.y());
  pixel.covariance_px2 = Eigen::Matrix2d::Identity() * std::pow(tracklet.measured_sd_px(), 2);
  pixel.belief = 1.0 / (1.0 + std::exp(-tracklet.log_ratio()));
  pixel.designation_sd_px = kCentring * tracklet.size_px().maxCoeff();
  pixel.detected = outline_of(tracklet);
  pixel.detected->velocity_px_s = tracklet.velocity_px_s();
  pixel.detected->velocity_sd_px_s = tracklet.velocity_sd_px_s();
  return pixel;
}

std::vector<PixelMeasurement> DetectedObjects::on_found(
    detector::Found found, const std::function<std::int64_t()>& new_track_id, double now_s) {
  const std::optional<Look> look = std::exchange(looks_, std::nullopt);
  if (!look) return {};
  counters_["detector_images"] += 1;
  if (found.suspended) counters_["detector_images_suspended"] += 1;
  std::erase_if(track_ids_, [&](const auto& entry) {
    return std::ranges::find(found.confirmed, entry.first, &detector::Tracklet::id) ==
           found.confirmed.end();
  });
  if (look->forgotten) return {};
  newest_ = std::move(found);
  note_followed(*look);
  std::vector<const detector::Tracklet*> shown;
  for (const detector::Tracklet& tracklet : newest_->confirmed) {
    const bool is_followed = look->followed && is_in(look->followed->box, tracklet);
    if (tracklet.seen() && !is_followed) shown.push_back(&tracklet);
  }
  std::ranges::stable_sort(shown, is_likelier);
  const auto most = std::min(shown.size(), static_cast<std::size_t>(config_.max_bearings));
  counters_["tracklets_not_sent"] += static_cast<double>(shown.size() - most);
  shown.resize(most);
  std::vector<PixelMeasurement> pixels;
  for (const detector::Tracklet* tracklet : shown) {
    pixels.push_back(measured(*tracklet, *look));
    pixels.back().arrived_s = now_s;
    pixels.back().track_id = track_id(tracklet->id(), new_track_id);
    pixels.back().detected->image_bearings = static_cast<int>(most);
  }
  return pixels;
}

void DetectedObjects::forget_angles() {
  waiting_.reset();
  looked_s_.reset();
  newest_.reset();
  of_followed_.reset();
  if (looks_) looks_->forgotten = true;
}

}  // namespace ols::station
