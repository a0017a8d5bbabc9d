#include "edge/tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "edge/tracker/motion_model.h"
#include "edge/tracker/paper_tracker.h"
#include "edge/tracker/tracker_core.h"

namespace ols::tracker {
namespace {

constexpr double kLeastBoxSide = 3.0;  // [px] smaller ones contain no pattern

std::optional<TrackerError> check_image(const TrackerInput& frame) {
  if (frame.gray.empty()) return TrackerError::kEmptyFrame;
  if (frame.gray.type() != CV_8UC1) return TrackerError::kFrameFormat;
  if (!frame.colour.empty() && !frame.colour.valid(frame.gray.size())) {
    return TrackerError::kFrameFormat;
  }
  if (!std::isfinite(frame.time_s)) return TrackerError::kTime;
  if (frame.predicted_homography && !frame.predicted_homography->allFinite()) {
    return TrackerError::kHomography;
  }
  return std::nullopt;
}

bool usable_box(const cv::Rect2d& box, const cv::Size& frame) {
  const bool finite = std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) &&
                      std::isfinite(box.height);
  if (!finite || box.width < kLeastBoxSide || box.height < kLeastBoxSide) return false;
  if (box.width > frame.width || box.height > frame.height) return false;
  // Labels at the border extend beyond it: the centre counts.
  const Eigen::Vector2d centre = centre_of(box);
  return centre.x() >= 0.0 && centre.y() >= 0.0 && centre.x() <= frame.width - 1.0 &&
         centre.y() <= frame.height - 1.0;
}

// An unusable prediction is discarded: the image may still show the motion. A usable one is taken
// at the scale at which it was checked.
TrackerInput with_sane_prediction(const TrackerInput& frame) {
  TrackerInput checked = frame;
  auto& predicted = checked.predicted_homography;
  if (!predicted) return checked;
  if (plausible_homography(*predicted, frame.gray.size())) {
    *predicted /= (*predicted)(2, 2);
  } else {
    predicted.reset();
  }
  return checked;
}

// The distance between a pixel's images by two homographies.
double disagreement_px(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b,
                       const Eigen::Vector2d& pixel, const cv::Size& frame) {
  const double most = std::hypot(frame.width, frame.height);
  const double off = (transform(a, pixel) - transform(b, pixel)).norm();
  return off < most ? off : most;  // NaN counts as far off
}

using Filter = std::variant<PaperTracker, TrackerCore>;

Filter make_filter(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
                   const cv::Rect2d& box) {
  if (config.mode == TrackerMode::kPaper) {
    return Filter(std::in_place_type<PaperTracker>, config, seed, frame, box);
  }
  return Filter(std::in_place_type<TrackerCore>, config, seed, frame, box);
}

}  // namespace

struct Tracker::Followed {
  Filter filter;
  cv::Size size;
  double time_s;
  Eigen::Vector2d pixel;  // of the target in the newest frame
};

Tracker::Tracker(const TrackerConfig& config, std::uint64_t seed) : config_(config), seed_(seed) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

std::optional<TrackerError> Tracker::initialise(const TrackerInput& frame, const cv::Rect2d& box) {
  if (const auto error = check_image(frame)) return error;
  if (!usable_box(box, frame.gray.size())) return TrackerError::kBox;
  followed_ = std::make_unique<Followed>(Followed{make_filter(config_, seed_, frame, box),
                                                  frame.gray.size(), frame.time_s, centre_of(box)});
  return std::nullopt;
}

TrackerResult Tracker::track(const TrackerInput& frame) {
  if (!followed_) return {std::nullopt, TrackerError::kNotInitialised};
  if (const auto error = check_image(frame)) return {std::nullopt, error};
  if (frame.gray.size() != followed_->size) return {std::nullopt, TrackerError::kFrameSize};
  if (frame.time_s <= followed_->time_s) return {std::nullopt, TrackerError::kTime};
  followed_->time_s = frame.time_s;
  timer_.start();
  const TrackerInput usable = with_sane_prediction(frame);
  return std::visit(
      [&](auto& filter) -> TrackerResult {
        TrackerOutput output = filter.step(usable, timer_);
        const auto& given = frame.predicted_homography;
        output.prediction_dropped = given && !usable.predicted_homography;
        output.image_motion = filter.image_motion();
        if (const auto& seen = output.image_motion; given && seen) {
          output.prediction_error_px =
              disagreement_px(*given, seen->homography, followed_->pixel, followed_->size);
        }
        followed_->pixel = output.pixel;
        return {output, std::nullopt};
      },
      followed_->filter);
}

void Tracker::search_near(const Eigen::Vector2d& pixel, double sd_px) {
  const bool usable = pixel.allFinite() && std::isfinite(sd_px) && sd_px >= 0.0;
  if (!followed_ || !usable) return;
  const cv::Size& size = followed_->size;
  const Particle hint = bounded({pixel, {0.0, 0.0}, {0.0, 0.0}}, size);
  const double near_px = std::min(sd_px, static_cast<double>(size.width));
  std::visit([&](auto& filter) { filter.search_near(hint.pixel, near_px); }, followed_->filter);
}

void Tracker::set_aside() { aside_ = std::move(followed_); }

void Tracker::take_back() {
  if (aside_) followed_ = std::move(aside_);
}

}  // namespace ols::tracker
