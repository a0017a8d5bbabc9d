// Keeps the tracklets of one camera: assigns detections to them, and confirms them by a sequential
// test.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "edge/detector/clutter_map.h"
#include "edge/detector/detection.h"
#include "edge/detector/stars.h"
#include "edge/detector/tracklet.h"

namespace ols::detector {

struct TrackletConfig {
  // Allowed number of false confirmations per hour, for the whole camera. (A confirmation is false
  // if the tracklet is clutter.)
  double false_an_hour = 1.0;
  double detected = 0.8;  // probability that an object is detected in an image
  // Clutter repeats itself in successive images. Therefore, one detection adds at most this much to
  // the log likelihood ratio of its tracklet.
  double most_log_ratio = 1.5;         // for a spot against a clear sky
  double most_ground_log_ratio = 0.7;  // for anything else
  // Each further detection of a dim point (Evidence::kStack) adds this to the log likelihood ratio.
  // Noise produces such a detection on a given path only once in 250 tries.
  double stack_log_ratio = 4.0;
  // For objects against the ground: minimum of (distance from start) / (path length).
  double least_directness = 0.7;
  double coast_s = 0.4;  // how long a confirmed tracklet is kept without detections
};

// Where a confirmed object is in the newest image by its appearance; nullopt if it is not
// recognised.
using Recognise = std::function<std::optional<Eigen::Vector2d>(const Tracklet&)>;

class TrackletBook {
 public:
  TrackletBook(const TrackletConfig& config, const cv::Size& image);

  // `motion` maps pixels of the previous image to the present one; nullopt if unknown.
  void advance(const std::vector<Detection>& detections,
               const std::optional<Eigen::Matrix3d>& motion, double interval_s,
               const Stars& stars = {}, const Recognise& recognise = {});
  const std::vector<Tracklet>& tracklets() const { return tracklets_; }

 private:
  std::vector<int> assign(const std::vector<Detection>& detections) const;
  double distance(const Tracklet& tracklet, const Detection& detection) const;
  void advance(Tracklet& tracklet, const Detection* detection, const Recognise& recognise);
  void leap(const std::vector<Detection>& detections, std::vector<bool>& taken);
  void weigh_hit(Tracklet& tracklet, const Detection& detection);
  void weigh_miss(Tracklet& tracklet);
  ClutterMap& clutter_of(const Detection& detection);
  // The threshold of the sequential test in the tracklet's tile, as a log likelihood ratio.
  double needed(const Tracklet& tracklet) const;
  void judge(Tracklet& tracklet) const;
  bool may_be_star(const Tracklet& tracklet) const;
  bool crowded(const Eigen::Vector2d& pixel) const;
  bool belongs_to_scene_or_camera(const Tracklet& tracklet) const;
  bool creeps(const Tracklet& tracklet) const;
  bool moves_or_flies(const Tracklet& tracklet) const;
  bool hopeless(const Tracklet& tracklet) const;

  TrackletConfig config_;
  // The clutter of single images, and that of stacks.
  ClutterMap clutter_, stack_clutter_;
  cv::Size image_;
  std::vector<Tracklet> tracklets_;
  Stars stars_;
  long next_id_ = 1;
};

}  // namespace ols::detector
