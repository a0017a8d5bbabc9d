// Replaces the visual tracker in Monte Carlo runs without images: its measurement is the true pixel
// plus random noise with the stated covariance.
#pragma once

#include <cstdint>
#include <deque>
#include <random>

#include "edge/tracker/target_tracker.h"
#include "sim/world/renderer.h"

namespace ols::sim {

// The truth about a station's recent frames, by time stamp.
class ViewMemory {
 public:
  void add(double time_s, const ViewTruth& view);
  // Null if no frame has exactly this stamp.
  const ViewTruth* at(double time_s) const;
  const ViewTruth& newest() const { return views_.back().second; }  // there must be one

 private:
  std::deque<std::pair<double, ViewTruth>> views_;
};

class ViewTracker final : public tracker::TargetTracker {
 public:
  // `views` must outlive the tracker. pixel_sd_px: white noise of each coordinate.
  ViewTracker(const ViewMemory& views, double pixel_sd_px, std::uint64_t seed);

  // The tracker follows the point in the middle of the box. The offset of this point from the
  // target's centre, across the line of sight, stays constant in metres.
  std::optional<tracker::TrackerError> initialise(const tracker::TrackerInput& frame,
                                                  const cv::Rect2d& box) override;
  tracker::TrackerResult track(const tracker::TrackerInput& frame) override;
  void search_near(const Eigen::Vector2d&, double) override {}
  void set_aside() override { aside_m_ = offset_m_; }
  void take_back() override { offset_m_ = aside_m_; }

 private:
  const ViewMemory& views_;
  double pixel_sd_px_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
  std::optional<Eigen::Vector2d> offset_m_, aside_m_;
};

}  // namespace ols::sim
