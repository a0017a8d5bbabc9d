// What a station needs of a tracker: the particle filter of edge/tracker, or whatever else measures
// a pixel (the Monte Carlo simulation draws one instead of rendering a picture).
#pragma once

#include <cstdint>
#include <optional>

#include "edge/tracker/tracker.h"

namespace ols {

class TargetTracker {
 public:
  virtual ~TargetTracker() = default;
  virtual std::optional<TrackerError> initialise(const TrackerInput& frame,
                                                 const cv::Rect2d& box) = 0;
  virtual TrackerResult track(const TrackerInput& frame) = 0;
  virtual void search_near(const Eigen::Vector2d& pixel, double sd_px) = 0;
};

class ParticleFilterTracker : public TargetTracker {
 public:
  ParticleFilterTracker(const TrackerConfig& config, std::uint64_t seed) : tracker_(config, seed) {}
  std::optional<TrackerError> initialise(const TrackerInput& frame,
                                         const cv::Rect2d& box) override {
    return tracker_.initialise(frame, box);
  }
  TrackerResult track(const TrackerInput& frame) override { return tracker_.track(frame); }
  void search_near(const Eigen::Vector2d& pixel, double sd_px) override {
    tracker_.search_near(pixel, sd_px);
  }

 private:
  Tracker tracker_;
};

}  // namespace ols
