// Publishes the outputs of an epoch in this order: targets, then bearing-only tracks, then the
// paper's estimates. Each bearing triggers only a part of them: many targets at once would delay
// the processing of bearings. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/clock_monitor.h"
#include "central/admission/fusion_log.h"
#include "central/fusion/bearing_lines.h"
#include "central/fusion/epoch_rule.h"
#include "central/fusion/fused_target.h"
#include "central/ground/land_use.h"
#include "central/tracking/track_manager.h"

namespace ols::fusion {

struct TargetScheduleConfig {
  std::string estimator = "filter";  // a name for make_estimator()
  double rate_hz = 15.0;             // largest number of epochs per second
  // Largest number of targets for which the paper's estimate is also computed; 0 for none.
  int paper_targets = 8;
  double give_up_s = 2.0;  // unpublished outputs of an epoch older than this are discarded
  EstimatorConfig estimators{};
  LandUse land{};
};

class TargetSchedule {
 public:
  explicit TargetSchedule(const TargetScheduleConfig& config) : config_(config) {}

  // Takes an admitted bearing, at the time now_us.
  void hear(const BearingMeasurement& measurement, std::int64_t now_us);
  // Adds the outputs that are due with one bearing, at the time now_us.
  void tell(std::int64_t now_us, TrackManager& tracks, const ClockMonitor& clocks,
            const PointingMonitor& pointing, FusionOutput& output, FusionLog& log);
  void forget(const std::string& station) { rule_.forget(station); }
  // The last epoch; nullopt before the first.
  std::optional<std::int64_t> epoch_us() const { return epoch_.utime_us; }
  void clear();

 private:
  struct Epoch {
    std::optional<std::int64_t> utime_us{};
    std::int64_t paper_us = 0;           // epoch of the paper's estimates
    std::deque<std::int64_t> targets{};  // ids that are still to be published
    bool bearing_only_reported = true;
    std::deque<std::int64_t> papers{};  // ids whose paper estimates are still to be published

    bool is_over() const { return bearing_only_reported && papers.empty(); }
  };
  struct Object {
    std::unique_ptr<Estimator> main, paper;
  };
  std::optional<std::int64_t> next_epoch(std::int64_t now_us);
  void begin(std::int64_t epoch_us, std::int64_t now_us, TrackManager& tracks);
  FusedTarget locate(const Track& track, bool by_paper, const TrackManager& tracks,
                     const ClockMonitor& clocks);
  void use_land(FusedTarget& target) const;
  void end_in_ground(FusedTarget& target) const;
  void report_bearing_only(TrackManager& tracks, const PointingMonitor& pointing,
                           FusionOutput& output);

  TargetScheduleConfig config_;
  EpochRule rule_;
  Epoch epoch_;
  std::map<std::int64_t, Object> objects_;  // by target id
};

}  // namespace ols::fusion
