// Notifies stations whose targets the land hides: when and where each target will reappear. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/station_registry.h"
#include "central/fusion/path_spread.h"
#include "central/fusion/slew_planner.h"
#include "central/ground/land_horizon.h"
#include "central/ground/occlusion.h"
#include "central/ground/seen_skylines.h"
#include "central/tracking/loss_watch.h"
#include "central/tracking/track.h"

namespace ols::fusion {

// A notice to one station about the target to which it is led.
struct OcclusionNotice {
  std::string station;
  std::int64_t utime_us = 0;  // message time at creation
  std::int64_t target_id = 0;
  double hidden = 0.0;  // the probability that the target is hidden at that time
  // When (after utime_us) and where the target reappears. Empty: not within the predicted time.
  std::optional<Emergence> exit{};
  double holds_s = 0.0;  // how long the notice holds; 0 withdraws the last notice
};

class OcclusionSchedule {
 public:
  // surface: null if no land is known; then nothing is hidden.
  explicit OcclusionSchedule(std::shared_ptr<const land::Surface> surface)
      : surface_(std::move(surface)) {}

  // The notices for the stations that get these slews.
  std::vector<OcclusionNotice> plan(std::int64_t now_us, const std::vector<Slew>& slews,
                                    const StationRegistry& stations,
                                    const std::vector<Track>& tracks, const SeenSkylines& skylines,
                                    const LossWatch& losses);
  void forget(const std::string& station) { told_.erase(station); }
  void clear() {
    told_.clear();
    spreads_.clear();
  }

 private:
  struct Told {
    std::unique_ptr<LandHorizon> horizon;
    std::int64_t exit_us = 0;  // until then, a wrong notice must be withdrawn
  };
  LandHorizon& horizon_of(Told& told, const Eigen::Vector3d& camera_ecef) const;

  std::shared_ptr<const land::Surface> surface_;
  std::map<std::string, Told> told_;
  std::map<std::int64_t, PathSpread> spreads_;  // by target
};

}  // namespace ols::fusion
