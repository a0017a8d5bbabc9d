#include "edge/detector/tracklet_book.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edge/detector/velocity_stack.h"
#include "geometry/assignment.h"

namespace ols::detector {
namespace {

constexpr double kGate = 16.0;      // squared standard deviations
constexpr double kReserve = 6.0;    // [log] that a confirmed tracklet keeps for misses
constexpr double kRejected = -2.5;  // [log] the test's lower bound
constexpr int kStackImages = VelocityStack::kImages;  // from one detection by a stack to the next
// [px] of the scene in the image. A smaller motion tells nothing: it may be the estimate's error.
constexpr double kTold_px = 4.0;
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

TrackletBook::TrackletBook(const TrackletConfig& config, const cv::Size& image)
    : config_(config), clutter_(image), stack_clutter_(image), image_(image) {}

// In squared standard deviations. The path of a dim point says which tracklet it is. A dim point
// and what single images show belong together only if they are close: between two stacks the
// prediction becomes so uncertain that all noise around would fit, and so does that of a tracklet
// of one image.
double TrackletBook::distance(const Tracklet& tracklet, const Detection& detection) const {
  constexpr double kNear_px = 6.0;
  if (tracklet.path() && detection.path && detection.path->id == *tracklet.path()) return 0.0;
  if ((tracklet.path() || detection.path) &&
      (detection.pixel - tracklet.pixel()).norm() > kNear_px) {
    return kNever;
  }
  return tracklet.distance(detection);
}

// For each tracklet the index of its detection, -1: none. As many as possible get one, confirmed
// ones before the others, and the nearest of these.
std::vector<int> TrackletBook::assign(const std::vector<Detection>& detections) const {
  Eigen::MatrixXd cost(tracklets_.size(), detections.size());
  for (std::size_t i = 0; i < tracklets_.size(); ++i) {
    const double rank = tracklets_[i].confirmed() ? 0.0 : 2.0 * kGate;
    for (std::size_t j = 0; j < detections.size(); ++j) {
      const double off = distance(tracklets_[i], detections[j]);
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          off > kGate ? kNever : rank + off;
    }
  }
  return ols::assign(cost, 4.0 * kGate);
}

// If the camera shakes, or its motion is unknown, a target leaves its prediction. In front of a
// clear sky there is little to confuse it with: a confirmed object continues at the only free spot
// nearby, if that looks alike.
void TrackletBook::leap(const std::vector<Detection>& detections, std::vector<bool>& taken) {
  constexpr double kReach = 0.05;  // of the image's width per image
  for (Tracklet& tracklet : tracklets_) {
    if (tracklet.seen() || !tracklet.confirmed_clear()) continue;
    const double reach_px = kReach * image_.width;
    std::vector<std::size_t> near_by;
    for (std::size_t j = 0; j < detections.size(); ++j) {
      if (taken[j] || !detections[j].clear) continue;
      if ((detections[j].pixel - tracklet.pixel()).norm() < reach_px) near_by.push_back(j);
    }
    if (near_by.size() != 1 || !tracklet.resembles(detections[near_by[0]])) continue;
    taken[near_by[0]] = true;
    tracklet.leap(detections[near_by[0]], image_.width);
  }
}

ClutterMap& TrackletBook::clutter_of(const Detection& detection) {
  return detection.path ? stack_clutter_ : clutter_;
}

// Wald's bound: at most exp(-bound) of the clutter's tracklets pass. The clutter map says how many
// begin in a tile, and each tile may have the same share of the allowed false ones.
double TrackletBook::needed(const Tracklet& tracklet) const {
  const double allowed = config_.false_an_hour / (ClutterMap::kColumns * ClutterMap::kRows);
  const ClutterMap& clutter = tracklet.path() ? stack_clutter_ : clutter_;
  return std::max(3.0, std::log(clutter.starts_an_hour(tracklet.pixel()) / allowed));
}

void TrackletBook::weigh_hit(Tracklet& tracklet, const Detection& detection) {
  if (detection.path) {
    tracklet.weigh(config_.stack_log_ratio, needed(tracklet) + kReserve);
    return;
  }
  const double ratio =
      config_.detected * tracklet.density(detection) / clutter_.density(detection.pixel);
  const double most = detection.clear ? config_.most_log_ratio : config_.most_ground_log_ratio;
  const double log_ratio = std::clamp(std::log(ratio), -3.0, most);
  tracklet.weigh(log_ratio, needed(tracklet) + kReserve);
}

// What only stacks show is expected in one image of several.
void TrackletBook::weigh_miss(Tracklet& tracklet) {
  if (tracklet.path() && tracklet.unseen_images() % kStackImages != 0) return;
  tracklet.weigh(std::log(1.0 - config_.detected), needed(tracklet) + kReserve);
}

// No clear sky shows something new all the time: waves on a dark sea, stars in haze, or rain.
bool TrackletBook::crowded(const Eigen::Vector2d& pixel) const {
  constexpr double kMost = 2.0;  // tracklets that begin in a tile in a second
  return clutter_.starts_an_hour(pixel) > 3600.0 * kMost;
}

// While the camera turns, what moves along with the scene is a part of it, and what stays where it
// is in the image is a part of the camera: a speck on the lens, a burnt-in text.
bool TrackletBook::belongs_to_scene_or_camera(const Tracklet& tracklet) const {
  constexpr double kAlong = 0.2;     // of the turn: parallax, and the error again
  constexpr double kFixed_px = 1.5;  // no controller holds a target as still as that
  const double shift_px = tracklet.scene_shift_px();
  if (shift_px < kTold_px) return false;
  return tracklet.way_px() < kTold_px / 2.0 + kAlong * shift_px || tracklet.reach_px() < kFixed_px;
}

// While the camera moves, the error of its motion adds up, and a scene at several distances shows
// parallax: its parts creep.
bool TrackletBook::creeps(const Tracklet& tracklet) const {
  constexpr double kLeastSpeed = 0.02;  // of the image's width per second
  return tracklet.scene_path_px() > kTold_px &&
         tracklet.way_px() < kLeastSpeed * image_.width * tracklet.way_s();
}

// What stands still in front of the ground is a part of it: foliage, a stone, an edge of a
// misaligned image. A spot in front of a clear sky need not move.
bool TrackletBook::moves_or_flies(const Tracklet& tracklet) const {
  if (belongs_to_scene_or_camera(tracklet)) return false;
  if (tracklet.path()) return true;  // a stack shows only what moves on a straight path
  if (tracklet.mostly_clear() && !crowded(tracklet.pixel())) return true;
  if (creeps(tracklet)) return false;
  const double way_px = tracklet.way_px();
  return way_px > 5.0 + 0.5 * tracklet.size_px().minCoeff() &&
         way_px > config_.least_directness * tracklet.path_px();
}

// A star is a clear spot like any other, and one that twinkles begins anew again and again. What
// hovers leaves the star's path within seconds, because the sky turns. The path is less certain the
// longer it is: the heading may be wrong, and a wide lens is no pinhole.
bool TrackletBook::may_be_star(const Tracklet& tracklet) const {
  constexpr double kSpot_px = 4.0, kShare = 0.2;
  if (!stars_.show) return false;
  return !stars_.motion || tracklet.off_star_px() < kSpot_px + kShare * tracklet.star_path_px();
}

void TrackletBook::judge(Tracklet& tracklet) const {
  if (tracklet.log_ratio() >= needed(tracklet) && moves_or_flies(tracklet) &&
      !may_be_star(tracklet))
    tracklet.confirm(!crowded(tracklet.pixel()));
  if (tracklet.rests() && !tracklet.confirmed_clear()) tracklet.doubt();
  if (belongs_to_scene_or_camera(tracklet)) tracklet.doubt();
}

bool TrackletBook::hopeless(const Tracklet& tracklet) const {
  const Eigen::Vector2d& pixel = tracklet.pixel();
  const bool outside =
      pixel.x() < 0.0 || pixel.y() < 0.0 || pixel.x() >= image_.width || pixel.y() >= image_.height;
  if (outside) return true;
  if (tracklet.path()) {
    return tracklet.log_ratio() < kRejected || tracklet.unseen_images() > 2 * kStackImages;
  }
  if (tracklet.confirmed()) return tracklet.unseen_s() > config_.coast_s;
  return tracklet.log_ratio() < kRejected || tracklet.unseen_s() > 0.5 * config_.coast_s;
}

// Detections against the ground often show only a part of an object, or what is beside it, too.
// There, the appearance of a confirmed object gives its place, as long as it is recognised.
void TrackletBook::advance(Tracklet& tracklet, const Detection* detection,
                           const Recognise& recognise) {
  if (detection) {
    weigh_hit(tracklet, *detection);
    if (!tracklet.confirmed()) clutter_of(*detection).add_detection(detection->pixel);
  }
  const bool well_detected = detection && tracklet.mostly_clear();
  const bool by_appearance = recognise && tracklet.confirmed() && !well_detected;
  if (const auto pixel = by_appearance ? recognise(tracklet) : std::nullopt) {
    tracklet.recognised(*pixel);
    if (detection) tracklet.compare_size(*detection);
  } else if (detection) {
    tracklet.update(*detection);
  } else {
    tracklet.miss();
    return weigh_miss(tracklet);
  }
  judge(tracklet);
}

void TrackletBook::advance(const std::vector<Detection>& detections,
                           const std::optional<Eigen::Matrix3d>& motion, double interval_s,
                           const Stars& stars, const Recognise& recognise) {
  constexpr double kForget_s = 1.0;  // a pause: what is there now may be any other object
  clutter_.next_image(interval_s);
  stack_clutter_.next_image(interval_s);
  if (interval_s > kForget_s) tracklets_.clear();
  stars_ = stars;
  for (Tracklet& tracklet : tracklets_) {
    tracklet.predict(motion.value_or(Eigen::Matrix3d::Identity()), interval_s, stars.motion);
    if (!motion) tracklet.forget_way();
  }
  const std::vector<int> assigned = assign(detections);
  std::vector<bool> taken(detections.size(), false);
  for (std::size_t i = 0; i < tracklets_.size(); ++i) {
    const Detection* const detection =
        assigned[i] < 0 ? nullptr : &detections[static_cast<std::size_t>(assigned[i])];
    if (detection) taken[static_cast<std::size_t>(assigned[i])] = true;
    advance(tracklets_[i], detection, recognise);
  }
  leap(detections, taken);
  std::erase_if(tracklets_, [this](const Tracklet& tracklet) { return hopeless(tracklet); });
  for (std::size_t j = 0; j < detections.size(); ++j) {
    if (taken[j]) continue;
    clutter_of(detections[j]).add_detection(detections[j].pixel);
    clutter_of(detections[j]).add_start(detections[j].pixel);
    tracklets_.emplace_back(next_id_++, detections[j], image_.width);
  }
}

}  // namespace ols::detector
