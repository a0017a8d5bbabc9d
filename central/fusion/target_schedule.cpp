#include "central/fusion/target_schedule.h"

#include <algorithm>
#include <set>

#include "central/fusion/output_period.h"
#include "central/ground/ground_point.h"
#include "central/measurement/time_span.h"
#include "central/tracking/target_appearance.h"

namespace ols::fusion {
namespace {

constexpr int kLines = 16;  // max bearing-only tracks per epoch
// Max targets per bearing; the paper's estimate of one costs as much as several.
constexpr int kTargetsABearing = 8, kPaperIsWorth = 4;

FusedTarget target_of(std::int64_t epoch_us, const Track& track, const char* estimator,
                      Located located) {
  FusedTarget target;
  target.utime_us = epoch_us;
  target.target_id = track.id;
  target.state = track.state;
  target.estimator = estimator;
  target.estimate = std::move(located.estimate);
  target.stations = std::move(located.stations);
  return target;
}

// Max stations of the paper's estimate when it accompanies another one. Its cost grows with their
// square, and would delay targets and slews.
constexpr int kPaperStations = 100;

EstimatorConfig beside(EstimatorConfig config) {
  config.paper.max_stations = kPaperStations;
  return config;
}

const Track* next_of(std::deque<std::int64_t>& waiting, const TrackManager& tracks) {
  const std::int64_t id = waiting.front();
  waiting.pop_front();
  const auto track = std::ranges::find(tracks.tracks(), id, &Track::id);
  return track == tracks.tracks().end() || !is_established(*track) ? nullptr : &*track;
}

}  // namespace

void TargetSchedule::clear() {
  rule_.clear();
  epoch_ = {};
  objects_.clear();
}

void TargetSchedule::hear(const BearingMeasurement& measurement, std::int64_t now_us) {
  rule_.hear(measurement.station, measurement.utime_us, now_us);
}

// Estimators without memory would have to extrapolate to the newest stamp. Their epoch is "now",
// which half of the stations have passed.
std::optional<std::int64_t> TargetSchedule::next_epoch(std::int64_t now_us) {
  if (predicts(config_.estimator)) return rule_.after(epoch_.utime_us, config_.rate_hz);
  return is_due(epoch_.utime_us, now_us, config_.rate_hz) ? std::optional(now_us) : std::nullopt;
}

void TargetSchedule::begin(std::int64_t epoch_us, std::int64_t now_us, TrackManager& tracks) {
  const std::int64_t last_paper_us = epoch_.paper_us;
  epoch_ = {.utime_us = epoch_us, .paper_us = now_us, .bearing_only_reported = false};
  tracks.advance(now_us);
  for (const Track& track : tracks.tracks()) {
    if (is_established(track)) epoch_.targets.push_back(track.id);
  }
  std::ranges::sort(epoch_.targets);
  std::erase_if(objects_, [this](const auto& object) {
    return !std::ranges::binary_search(epoch_.targets, object.first);
  });
  if (now_us <= last_paper_us) return;  // they are made in order of time
  const auto papers =
      std::min(epoch_.targets.size(), static_cast<std::size_t>(config_.paper_targets));
  epoch_.papers.assign(epoch_.targets.begin(),
                       epoch_.targets.begin() + static_cast<std::ptrdiff_t>(papers));
}

void TargetSchedule::tell(std::int64_t now_us, TrackManager& tracks, const ClockMonitor& clocks,
                          const PointingMonitor& pointing, FusionOutput& output, FusionLog& log) {
  // After a silence, pending outputs are discarded: their tracks may be deleted by now.
  const bool is_old = epoch_.utime_us && seconds(now_us - *epoch_.utime_us) > config_.give_up_s;
  if (!epoch_.is_over() && is_old)
    epoch_ = {.utime_us = epoch_.utime_us, .paper_us = epoch_.paper_us};
  if (epoch_.is_over()) {
    if (const auto next_us = next_epoch(now_us)) begin(*next_us, now_us, tracks);
  }
  if (epoch_.is_over()) return;
  int work = 0;
  for (; work < kTargetsABearing && !epoch_.targets.empty(); ++work) {
    const Track* const track = next_of(epoch_.targets, tracks);
    if (track != nullptr) output.targets.push_back(locate(*track, false, tracks, clocks));
  }
  if (epoch_.targets.empty() && !epoch_.bearing_only_reported)
    report_bearing_only(tracks, pointing, output);
  for (; work < kTargetsABearing && epoch_.bearing_only_reported && !epoch_.papers.empty();
       work += kPaperIsWorth) {
    const Track* const track = next_of(epoch_.papers, tracks);
    if (track == nullptr) continue;
    output.targets_paper.push_back(locate(*track, true, tracks, clocks));
    if (track->bearings.size() > kPaperStations) log.count("paper_targets_thinned");
  }
  for (const FusedTarget& target : output.targets) {
    const bool located = target.estimate.solution == Solution::kOk;
    log.count(located ? "targets" : "targets_without_position");
  }
}

FusedTarget TargetSchedule::locate(const Track& track, bool by_paper, const TrackManager& tracks,
                                   const ClockMonitor& clocks) {
  Object& object = objects_[track.id];
  if (!object.main) {
    object.main = make_estimator(config_.estimator, config_.estimators);
    object.paper = make_estimator("paper", beside(config_.estimators));
  }
  Estimator& estimator = by_paper ? *object.paper : *object.main;
  const std::int64_t epoch_us = by_paper ? epoch_.paper_us : *epoch_.utime_us;
  Located located = estimator.locate({track.bearings, tracks.errors(), &track.filter}, epoch_us);
  if (!by_paper) {
    std::erase_if(located.stations, [&](const ContributingStation& station) {
      return !clocks.quarantine(station.station).empty();
    });
  }
  FusedTarget target = target_of(epoch_us, track, estimator.name(), std::move(located));
  if (target.estimate.solution == Solution::kOk) {
    target.appearance = appearance_of(track, target.estimate.position_ecef);
    if (!by_paper) use_land(target);
  }
  return target;
}

// The height above ground of a located target. If it is seen by a station whose objects stand on
// the ground by the configuration, the ground improves its position.
void TargetSchedule::use_land(FusedTarget& target) const {
  if (!config_.land.surface) return;
  const land::Surface& surface = *config_.land.surface;
  Estimate& estimate = target.estimate;
  const bool stands = std::ranges::any_of(target.stations, [this](const ContributingStation& s) {
    return s.used && config_.land.follows_on_ground(s.station);
  });
  if (stands) {
    if (const auto placed =
            put_on_ground(surface, {estimate.position_ecef, estimate.covariance_ecef})) {
      estimate.position_ecef = placed->p_ecef;
      estimate.covariance_ecef = placed->covariance_ecef;
    }
  }
  target.above_ground =
      height_above_ground(surface, estimate.position_ecef, estimate.covariance_ecef);
}

// A bearing-only track of an object on the ground has a position: where its line of sight meets the
// ground.
void TargetSchedule::end_in_ground(FusedTarget& target) const {
  if (target.target_id == 0) return;
  const auto point = ground_point(*config_.land.surface, target.bearing_only->sight);
  if (!point) return;
  target.estimator = "ground";
  target.state = TrackState::kConfirmed;
  target.bearing_only.reset();
  target.estimate.solution = Solution::kOk;
  target.estimate.position_ecef = point->p_ecef;
  target.estimate.covariance_ecef = point->covariance_ecef;
  target.estimate.covariance_white_ecef = point->covariance_white_ecef;
  target.above_ground = HeightAboveGround{kMiddle_m, kMiddleSd_m};
}

// Without a located target, reports the reason or the single bearing-only track. Also reports the
// bearing-only track of each station that follows an object other than the targets.
void TargetSchedule::report_bearing_only(TrackManager& tracks, const PointingMonitor& pointing,
                                         FusionOutput& output) {
  epoch_.bearing_only_reported = true;
  const BearingLines lines(tracks, pointing, config_.estimators.alignment);
  const std::int64_t epoch_us = *epoch_.utime_us;
  const bool located = std::ranges::any_of(tracks.tracks(), is_established);
  const std::vector<std::string> stations = lines.stations(epoch_us);
  FusedTarget target;
  target.utime_us = epoch_us;
  target.estimator = config_.estimator;
  if (!located && stations.size() != 1) {
    target.estimate.solution = tracks.is_ambiguous() ? Solution::kAmbiguous
                               : stations.empty()    ? Solution::kTooFewRays
                                                     : tracks.why_no_track_began();
    for (const std::string& station : stations)
      target.stations.push_back({station, true, 1.0, 0.0});
    output.targets.push_back(target);
  }
  target.estimate.solution = Solution::kBearingOnly;
  const bool alone = !located && stations.size() == 1;
  std::set<std::int64_t> told;
  int count = 0;
  for (const std::string& station : stations) {
    auto newest = lines.of(station, epoch_us);
    if (newest.empty() && alone) newest.push_back(lines.newest_of(station));
    for (const BearingMeasurement* const measurement : newest) {
      const auto line = lines.at(*measurement, epoch_us);
      if (!line) continue;
      if (++count > kLines) return;
      target.target_id = tracks.identify(*measurement, told);
      target.stations = {{station, true, 1.0, 0.0}};
      target.bearing_only = line;
      output.targets.push_back(target);
      if (config_.land.follows_on_ground(station)) end_in_ground(output.targets.back());
    }
  }
}

}  // namespace ols::fusion
