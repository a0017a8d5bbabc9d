// What a station needs of a tracker: the particle filter of edge/tracker, or whatever else measures
// a pixel (the Monte Carlo simulation draws one instead of rendering a picture).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "edge/tracker/tracker.h"

namespace ols {

class TargetTracker {
 public:
  virtual ~TargetTracker() = default;
  virtual std::optional<TrackerError> initialise(const TrackerInput& frame,
                                                 const cv::Rect2d& box) = 0;
  virtual TrackerResult track(const TrackerInput& frame) = 0;
  virtual void search_near(const Eigen::Vector2d& pixel, double sd_px) = 0;
  // Puts the target aside, in place of one that was; initialise() begins another one then.
  virtual void set_aside() = 0;
  // Goes on with the one that was put aside; once.
  virtual void take_back() = 0;
};

class ParticleFilterTracker : public TargetTracker {
 public:
  ParticleFilterTracker(const TrackerConfig& config, std::uint64_t seed)
      : config_(config), seed_(seed), tracker_(config, seed) {}
  std::optional<TrackerError> initialise(const TrackerInput& frame,
                                         const cv::Rect2d& box) override {
    return tracker_.initialise(frame, box);
  }
  TrackerResult track(const TrackerInput& frame) override { return tracker_.track(frame); }
  void search_near(const Eigen::Vector2d& pixel, double sd_px) override {
    tracker_.search_near(pixel, sd_px);
  }
  void set_aside() override { aside_ = std::exchange(tracker_, Tracker(config_, seed_)); }
  void take_back() override {
    if (aside_) tracker_ = std::move(*aside_);
    aside_.reset();
  }

 private:
  TrackerConfig config_;
  std::uint64_t seed_;
  Tracker tracker_;
  std::optional<Tracker> aside_;
};

}  // namespace ols
