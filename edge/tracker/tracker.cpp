#include "edge/tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/tracker/motion_model.h"
#include "edge/tracker/paper_tracker.h"
#include "edge/tracker/tracker_core.h"

namespace ols {
namespace {

constexpr double kLeastBoxSide = 3.0;  // [px] smaller ones hold no pattern

std::optional<TrackerError> check_image(const TrackerInput& frame) {
  if (frame.gray.empty()) return TrackerError::kEmptyFrame;
  if (frame.gray.type() != CV_8UC1) return TrackerError::kFrameFormat;
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
  // Labels at the border reach over it: the centre counts.
  const Eigen::Vector2d centre = centre_of(box);
  return centre.x() >= 0.0 && centre.y() >= 0.0 && centre.x() <= frame.width - 1.0 &&
         centre.y() <= frame.height - 1.0;
}

// An unusable prediction is none: the image may still tell. A usable one is taken at the scale at
// which it was judged.
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

// How far apart two homographies put a pixel.
double disagreement_px(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b,
                       const Eigen::Vector2d& pixel, const cv::Size& frame) {
  const double most = std::hypot(frame.width, frame.height);
  const double off = (transform(a, pixel) - transform(b, pixel)).norm();
  return off < most ? off : most;  // one that is no number is far off
}

}  // namespace

const char* to_string(TrackerError error) {
  switch (error) {
    case TrackerError::kNotInitialised:
      return "not initialised";
    case TrackerError::kEmptyFrame:
      return "empty frame";
    case TrackerError::kFrameFormat:
      return "frame is not 8-bit with one channel";
    case TrackerError::kFrameSize:
      return "frame has another size";
    case TrackerError::kTime:
      return "frame is not later than the previous one";
    case TrackerError::kHomography:
      return "predicted homography is not finite";
    case TrackerError::kBox:
      return "box is outside the image, too small or not finite";
  }
  return "unknown";
}

struct Tracker::Impl {
  TrackerConfig config;
  std::uint64_t seed = 0;
  std::unique_ptr<TargetFollower> follower;
  StageTimer timer;
  cv::Size size;
  double time_s = 0.0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // of the target in the newest frame
};

Tracker::Tracker(const TrackerConfig& config, std::uint64_t seed)
    : impl_(std::make_unique<Impl>(
          Impl{config, seed, nullptr, {}, {}, 0.0, Eigen::Vector2d::Zero()})) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

std::optional<TrackerError> Tracker::initialise(const TrackerInput& frame, const cv::Rect2d& box) {
  if (const auto error = check_image(frame)) return error;
  if (!usable_box(box, frame.gray.size())) return TrackerError::kBox;
  if (impl_->config.mode == TrackerMode::kPaper) {
    impl_->follower = std::make_unique<PaperTracker>(impl_->config, impl_->seed, frame, box);
  } else {
    impl_->follower = std::make_unique<TrackerCore>(impl_->config, impl_->seed, frame, box);
  }
  impl_->size = frame.gray.size();
  impl_->time_s = frame.time_s;
  impl_->pixel = centre_of(box);
  return std::nullopt;
}

TrackerResult Tracker::track(const TrackerInput& frame) {
  if (!impl_->follower) return {std::nullopt, TrackerError::kNotInitialised};
  if (const auto error = check_image(frame)) return {std::nullopt, error};
  if (frame.gray.size() != impl_->size) return {std::nullopt, TrackerError::kFrameSize};
  if (frame.time_s <= impl_->time_s) return {std::nullopt, TrackerError::kTime};
  impl_->time_s = frame.time_s;
  impl_->timer.start();
  const TrackerInput usable = with_sane_prediction(frame);
  TrackerOutput output = impl_->follower->step(usable, impl_->timer);
  const auto& given = frame.predicted_homography;
  output.prediction_dropped = given && !usable.predicted_homography;
  if (const auto& seen = impl_->follower->image_homography(); given && seen) {
    output.prediction_error_px = disagreement_px(*given, *seen, impl_->pixel, impl_->size);
  }
  impl_->pixel = output.pixel;
  return {output, std::nullopt};
}

void Tracker::search_near(const Eigen::Vector2d& pixel, double sd_px) {
  const bool usable = pixel.allFinite() && std::isfinite(sd_px) && sd_px >= 0.0;
  if (!impl_->follower || !usable) return;
  const cv::Size& size = impl_->size;
  const Particle hint = bounded({pixel, {0.0, 0.0}, {0.0, 0.0}}, size);
  impl_->follower->search_near(hint.pixel, std::min(sd_px, static_cast<double>(size.width)));
}

bool Tracker::initialised() const { return impl_->follower != nullptr; }

void Tracker::set_stage_clock(StageClock clock) { impl_->timer.set_clock(std::move(clock)); }

const StageTimes& Tracker::stage_times() const { return impl_->timer.times(); }

}  // namespace ols
