// The visual tracker (paper section 5): takes images, and returns one pixel measurement for each.
//
// It does not depend on PTU counts, LCM, files or clocks. Its inputs are an image, its time and, if
// known, the predicted ego-motion. It is deterministic: the same seed and images give the same
// output.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "edge/tracker/stage_times.h"
#include "edge/tracker/target_tracker.h"
#include "edge/tracker/tracker_config.h"

namespace ols::tracker {

class Tracker final : public TargetTracker {
 public:
  Tracker(const TrackerConfig& config, std::uint64_t seed);
  ~Tracker() override;
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  std::optional<TrackerError> initialise(const TrackerInput& frame, const cv::Rect2d& box) override;
  // Performs one step: ego-motion, prediction (2)-(4), weighting (5), MAP, resampling.
  TrackerResult track(const TrackerInput& frame) override;
  // Moves the particles to the pixel, and keeps the template.
  void search_near(const Eigen::Vector2d& pixel, double sd_px) override;
  void set_aside() override;
  void take_back() override;

  bool initialised() const { return followed_ != nullptr; }

  // Without a clock, no times are measured. stage_times() returns the times of the newest frame.
  void set_stage_clock(StageClock clock) { timer_.set_clock(std::move(clock)); }
  const StageTimes& stage_times() const { return timer_.times(); }

 private:
  struct Followed;  // a target with its filter

  TrackerConfig config_;
  std::uint64_t seed_;
  std::unique_ptr<Followed> followed_;
  std::unique_ptr<Followed> aside_;
  StageTimer timer_;
};

}  // namespace ols::tracker
