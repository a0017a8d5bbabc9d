#include "edge/tracker/acquisition.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/alignment.h"

namespace ols::tracker {
namespace {

// A part of the image and the object to look for in it.
struct Scope {
  cv::Rect area;
  cv::Mat raw, gray;  // original and smoothed
  Eigen::Vector2d expected_px, line;
  double gate_px;

  double off_px(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d off = pixel - expected_px;
    return (off - off.dot(line) * line).norm();
  }
};

// The part of the picture in which to look: around the expected pixel, or along its line.
cv::Rect looked_at(const AcquisitionView& view, double half_px) {
  const cv::Rect picture(0, 0, view.gray.cols, view.gray.rows);
  const double reach_px = view.line.isZero() ? 0.0 : std::hypot(picture.width, picture.height);
  const Eigen::Vector2d half = (reach_px * view.line).cwiseAbs().array() + half_px;
  const Eigen::Vector2d corner = view.expected_px - half;
  return cv::Rect(static_cast<int>(corner.x()), static_cast<int>(corner.y()),
                  static_cast<int>(2.0 * half.x()), static_cast<int>(2.0 * half.y())) &
         picture;
}

cv::Mat smoothed(const cv::Mat& image) {
  cv::Mat smooth;
  cv::GaussianBlur(image, smooth, cv::Size(0, 0), 1.0);
  return smooth;
}

cv::Mat square(int side) { return cv::getStructuringElement(cv::MORPH_RECT, {side, side}); }

// The quantile of the pixels of an 8-bit image, from every few pixels.
double quantile(const cv::Mat& image, double share) {
  constexpr int kStep = 3;
  std::array<int, 256> histogram{};
  int all = 0;
  for (int row = 0; row < image.rows; row += kStep) {
    const auto* line = image.ptr<std::uint8_t>(row);
    for (int i = 0; i < image.cols; i += kStep, ++all) ++histogram[line[i]];
  }
  int below = 0;
  for (int value = 0; value < 256; ++value) {
    below += histogram[static_cast<std::size_t>(value)];
    if (below > share * all) return value;
  }
  return 255.0;
}

// Where a reference shows nothing the image is compared with itself: no difference.
cv::Mat difference(const Scope& scope, const AcquisitionReference& reference) {
  const cv::Mat before = smoothed(
      brought_to_present(reference.gray, reference.homography, scope.raw, scope.area.tl()));
  // The angles place the background to about a pixel: a pixel with an equal neighbour is unchanged.
  cv::Mat low, high, above, below;
  cv::erode(before, low, square(5));
  cv::dilate(before, high, square(5));
  cv::subtract(scope.gray, high, above);  // saturates at zero
  cv::subtract(low, scope.gray, below);
  return cv::max(above, below);
}

// Differences from both earlier frames: the target's earlier place differs from one only.
cv::Mat moving(const Scope& scope, const std::vector<AcquisitionReference>& references,
               double apart_px) {
  const AcquisitionReference* near = nullptr;
  for (const AcquisitionReference& reference : references) {
    const double from_now_px = (reference.expected_px - scope.expected_px).norm();
    if (near == nullptr && from_now_px >= apart_px) {
      near = &reference;
    } else if (near != nullptr && from_now_px >= apart_px &&
               (reference.expected_px - near->expected_px).norm() >= apart_px) {
      return cv::min(difference(scope, *near), difference(scope, reference));
    }
  }
  return {};
}

// Objects smaller than `side_px` and darker or brighter than all around; edges do not count.
cv::Mat standing_out(const Scope& scope, double side_px) {
  const cv::Mat element = square(2 * static_cast<int>(side_px / 2.0) + 1);
  cv::Mat dark, bright;
  cv::morphologyEx(scope.gray, dark, cv::MORPH_BLACKHAT, element);
  cv::morphologyEx(scope.gray, bright, cv::MORPH_TOPHAT, element);
  return cv::max(dark, bright);
}

bool inside(const Scope& scope, const cv::Rect& box) {
  return box.x > 0 && box.y > 0 && box.br().x < scope.area.width && box.br().y < scope.area.height;
}

Eigen::Vector2d centre_px(const cv::Rect2d& box) {
  return {box.x + 0.5 * box.width - 0.5, box.y + 0.5 * box.height - 0.5};
}

Eigen::Vector2d moved_by(const Eigen::Matrix3d& homography, const Eigen::Vector2d& pixel) {
  return (homography * pixel.homogeneous()).hnormalized();
}

double longer_side(const cv::Rect2d& box) { return std::max(box.width, box.height); }

// Compact parts of `cue` above its own fluctuations.
std::vector<AcquisitionCandidate> compact(const Scope& scope, const cv::Mat& cue,
                                          const AcquisitionConfig& config) {
  const double middle = quantile(cue, 0.5);
  // The quartile's distance from the median, scaled to a normal distribution's sigma.
  const double spread = std::max(0.5, (quantile(cue, 0.75) - middle) / 0.6745);
  const double threshold = std::max(config.least_contrast, middle + config.threshold_sd * spread);
  cv::Mat mask, labels, statistics, centroids;
  cv::threshold(cue, mask, threshold, 255.0, cv::THRESH_BINARY);
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, square(9));  // joins a target's parts
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids);
  std::vector<AcquisitionCandidate> found;
  for (int i = 1; i < count; ++i) {
    const cv::Rect box(
        statistics.at<int>(i, cv::CC_STAT_LEFT), statistics.at<int>(i, cv::CC_STAT_TOP),
        statistics.at<int>(i, cv::CC_STAT_WIDTH), statistics.at<int>(i, cv::CC_STAT_HEIGHT));
    const double area_px2 = statistics.at<int>(i, cv::CC_STAT_AREA);
    constexpr double kLeastFill = 0.2, kMostAspect = 6.0;
    const cv::Rect2d in_frame = cv::Rect2d(box) + cv::Point2d(scope.area.tl());
    if (!inside(scope, box) || area_px2 < kLeastFill * box.area() ||
        longer_side(box) < config.least_side_px || longer_side(box) > config.most_side_px ||
        longer_side(box) > kMostAspect * std::min(box.width, box.height) ||
        scope.off_px(centre_px(in_frame)) > scope.gate_px) {
      continue;
    }
    found.push_back({in_frame, cv::mean(cue(box), mask(box))[0] * area_px2});
  }
  return found;
}

bool overlap(const cv::Rect2d& a, const cv::Rect2d& b) { return (a & b).area() > 0.0; }

}  // namespace

std::optional<cv::Rect2d> Acquisition::look(const AcquisitionView& view) {
  candidates_.clear();
  const double gate_px = std::min(config_.gate_sigma * view.expected_sd_px, config_.gate_most_px);
  const cv::Rect area = looked_at(view, gate_px + config_.most_side_px);
  if (view.gray.type() != CV_8UC1 || std::min(area.width, area.height) < config_.most_side_px) {
    clear();
    return std::nullopt;
  }
  const Scope scope{area,      view.gray(area), smoothed(view.gray(area)), view.expected_px,
                    view.line, gate_px};
  candidates_ = compact(scope, standing_out(scope, config_.most_side_px), config_);
  const cv::Mat motion = moving(scope, view.references, config_.most_side_px);
  // A target in front of a smooth background is complete already.
  for (const auto& mover :
       motion.empty() ? std::vector<AcquisitionCandidate>{} : compact(scope, motion, config_)) {
    const auto same = [&](const auto& other) { return overlap(other.box, mover.box); };
    if (std::none_of(candidates_.begin(), candidates_.end(), same)) candidates_.push_back(mover);
  }
  std::vector<Track> now;
  for (const auto& candidate : candidates_) now.push_back(continued(candidate, view));
  tracks_ = std::move(now);
  return sole(!view.line.isZero());
}

// Where the expected motion is right, it stays at the expected place; along a line it moves evenly
// against the background.
Acquisition::Track Acquisition::continued(const AcquisitionCandidate& candidate,
                                          const AcquisitionView& view) const {
  const bool on_line = !view.line.isZero();
  const Eigen::Vector2d centre = centre_px(candidate.box);
  const Eigen::Vector2d offset_px = centre - view.expected_px;
  Track track{candidate, on_line ? centre : offset_px};
  const double size_px = longer_side(candidate.box);
  const double reach_px = config_.place_px + config_.place_fraction * size_px;
  if (on_line && view.references.empty()) return track;
  for (const Track& before : tracks_) {
    Eigen::Vector2d first_px = before.first_px, step_px = Eigen::Vector2d::Zero();
    if (on_line) {
      const Eigen::Matrix3d& carried = view.references.front().homography;
      step_px = centre - moved_by(carried, centre_px(before.candidate.box));
      first_px = moved_by(carried, first_px);
    }
    const bool goes_on = !on_line           ? (offset_px - first_px).norm() <= reach_px
                         : before.seen == 1 ? step_px.norm() <= view.drift_px + reach_px
                                            : (step_px - before.step_px).norm() <= reach_px;
    const double ratio = size_px / longer_side(before.candidate.box);
    if (!goes_on || ratio >= config_.size_ratio || 1.0 / ratio >= config_.size_ratio) continue;
    if (before.seen < track.seen) continue;
    track.seen = before.seen + 1;
    track.first_px = first_px;
    track.step_px = step_px;
  }
  return track;
}

// An object that was also in the previous frame, at the right place, is no fluctuation: it
// competes. On a line, whatever stands there may be part of the scenery.
std::optional<cv::Rect2d> Acquisition::sole(bool movers_only) const {
  std::vector<Track> tracks;
  std::ranges::copy_if(tracks_, std::back_inserter(tracks), [&](const Track& track) {
    const double moved_px = (centre_px(track.candidate.box) - track.first_px).norm();
    return !movers_only || moved_px >= config_.place_px;
  });
  const auto best =
      std::max_element(tracks.begin(), tracks.end(), [](const auto& a, const auto& b) {
        return std::pair(a.seen > 1, a.candidate.strength) <
               std::pair(b.seen > 1, b.candidate.strength);
      });
  if (best == tracks.end() || best->seen < config_.frames) return std::nullopt;
  const auto rivals = std::count_if(tracks.begin(), tracks.end(), [&](const Track& other) {
    return other.seen > 1 &&
           other.candidate.strength > config_.rival_fraction * best->candidate.strength;
  });
  if (rivals > 1) return std::nullopt;  // includes the candidate itself
  constexpr double kPadding = 0.1;
  const cv::Rect2d& box = best->candidate.box;
  const cv::Size2d pad(1.0 + kPadding * box.width, 1.0 + kPadding * box.height);
  return cv::Rect2d(box.tl() - cv::Point2d(pad), box.size() + pad + pad);
}

}  // namespace ols::tracker
