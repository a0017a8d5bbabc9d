#include "edge/detector/detector.h"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

namespace ols::detector {
namespace {

constexpr int kMotionWidth_px = 640;  // of the image for ego-motion, maximum
constexpr int kMoverWidth_px = 400;   // of the image for movers, maximum

// Adds the movers that are no spots: of an object that is both, the spot has the better position.
void join(std::vector<Detection>& spots, const std::vector<Detection>& movers) {
  const std::size_t count = spots.size();
  for (const Detection& mover : movers) {
    const auto same = [&](const Detection& spot) {
      const Eigen::Vector2d apart = (spot.pixel - mover.pixel).cwiseAbs();
      const Eigen::Vector2d reach = 0.5 * mover.size_px + Eigen::Vector2d(4.0, 4.0);
      return apart.x() < reach.x() && apart.y() < reach.y() &&
             mover.size_px.prod() < 16.0 * spot.size_px.prod();
    };
    const auto end = spots.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::none_of(spots.begin(), end, same)) spots.push_back(mover);
  }
}

// Adds the dim points that are no part of anything that single images show: the edge of a larger
// object is a dim point, too.
void join(std::vector<Detection>& shown, const std::vector<Detection>& dim,
          const std::vector<Tracklet>& tracklets) {
  constexpr double kMargin_px = 8.0;
  const auto covers = [](const Eigen::Vector2d& pixel, const Eigen::Vector2d& size_px,
                         const Detection& point) {
    const Eigen::Vector2d apart = (point.pixel - pixel).cwiseAbs() - 0.5 * size_px;
    return apart.maxCoeff() < kMargin_px;
  };
  const std::size_t count = shown.size();
  for (const Detection& point : dim) {
    const bool is_shown = std::any_of(
        shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(count),
        [&](const Detection& other) { return covers(other.pixel, other.size_px, point); });
    const bool is_known = std::ranges::any_of(tracklets, [&](const Tracklet& tracklet) {
      return tracklet.confirmed() && !tracklet.path() &&
             covers(tracklet.pixel(), tracklet.size_px(), point);
    });
    if (!is_shown && !is_known) shown.push_back(point);
  }
}

// The box of the likeliest object in front of the sky, with a margin. Its corners are often the
// only ones there, and would make the scene seem to move along with it.
cv::Rect2d clearest_box(const std::vector<Tracklet>& tracklets) {
  constexpr double kMargin_px = 8.0;
  const Tracklet* clearest = nullptr;
  for (const Tracklet& tracklet : tracklets) {
    if (!tracklet.mostly_clear()) continue;
    if (!clearest || tracklet.log_ratio() > clearest->log_ratio()) clearest = &tracklet;
  }
  if (!clearest) return {};
  const Eigen::Vector2d side = clearest->size_px().array() + 2.0 * kMargin_px;
  const Eigen::Vector2d corner = clearest->pixel() - 0.5 * side;
  return {corner.x(), corner.y(), side.x(), side.y()};
}

}  // namespace

Detector::Detector(const DetectorConfig& config, const cv::Size& image)
    : ego_motion_(tracker::TrackerConfig{}, tracker::HomographyFit::kLeastSquares),
      spots_(config.spots),
      movers_(config.movers),
      dim_(config.dim),
      book_(config.tracklets, image) {}

std::optional<tracker::ImageMotion> Detector::measure_motion(
    const tracker::ReducedFrame& frame, const std::optional<Eigen::Matrix3d>& predicted) {
  if (!time_s_) {
    ego_motion_.start(frame);
    return std::nullopt;
  }
  return ego_motion_.step(frame, clearest_box(book_.tracklets()), predicted).motion;
}

Detector::Result Detector::advance(const cv::Mat& gray, double time_s,
                                   const std::optional<Eigen::Matrix3d>& predicted,
                                   const Stars& stars) {
  const tracker::ReducedFrame frame = tracker::reduce_frame(gray, kMotionWidth_px);
  tracker::ReducedFrame small = tracker::reduce_frame(frame.image, kMoverWidth_px);
  small.reduction *= frame.reduction;
  Result result;
  result.motion = measure_motion(frame, predicted);
  std::optional<Eigen::Matrix3d> motion = time_s_ ? predicted : std::nullopt;
  if (result.motion) motion = result.motion->homography;
  const double interval_s = time_s_ ? time_s - *time_s_ : 0.0;
  time_s_ = time_s;
  std::optional<Eigen::Matrix3d> reduced_motion;
  if (motion) reduced_motion = small.to_full().inverse() * *motion * small.to_full();
  const auto movers = movers_.find(small, time_s, reduced_motion);
  result.suspended = !movers.has_value();
  result.detections = spots_.find(gray);
  if (result.suspended) {
    ++suspended_images_;
    dim_.clear();
  } else {
    join(result.detections, *movers);
    join(result.detections, dim_.find(gray, time_s, motion), book_.tracklets());
  }
  appearances_.next_image(gray, time_s);
  book_.advance(result.detections, motion, interval_s, stars,
                [this](const Tracklet& one) { return appearances_.find(one); });
  appearances_.learn(book_.tracklets());
  return result;
}

}  // namespace ols::detector
