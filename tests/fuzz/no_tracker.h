// A tracker that accepts every box and never finds a target, for fuzzers that send commands to a
// station.
#pragma once

#include <optional>

#include "edge/tracker/target_tracker.h"

namespace ols::fuzz {

class NoTracker final : public tracker::TargetTracker {
 public:
  std::optional<tracker::TrackerError> initialise(const tracker::TrackerInput&,
                                                  const cv::Rect2d&) override {
    return std::nullopt;
  }
  tracker::TrackerResult track(const tracker::TrackerInput&) override { return {}; }
  void search_near(const Eigen::Vector2d&, double) override {}
  void set_aside() override {}
  void take_back() override {}
};

}  // namespace ols::fuzz
