#include "central/offline/offline_fusion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "central/fusion/track_intake.h"
#include "central/offline/smoother.h"
#include "central/tracking/recorded_track.h"
#include "geometry/angles.h"

namespace ols::fusion {
namespace {

// The bearings that are used, sorted by time, then by station.
BearingPointers in_order(const BearingPointers& measurements, double min_belief,
                         UnusedBearings& unused) {
  BearingPointers used;
  used.reserve(measurements.size());
  std::ranges::copy_if(measurements, std::back_inserter(used),
                       [&](const BearingMeasurement* m) { return m->belief >= min_belief; });
  unused.low_belief = measurements.size() - used.size();
  const auto exposure = [](const BearingMeasurement* m) {
    return std::tie(m->utime_us, m->station);
  };
  std::ranges::stable_sort(used, {}, exposure);
  // Not std::ranges::unique: clang 14 does not compile the range that it returns.
  const auto doubled = std::unique(used.begin(), used.end(),
                                   [&](const BearingMeasurement* a, const BearingMeasurement* b) {
                                     return exposure(a) == exposure(b);
                                   });
  unused.duplicate = static_cast<std::size_t>(used.end() - doubled);
  used.erase(doubled, used.end());
  return used;
}

StationBearings by_station(const BearingPointers& bearings) {
  StationBearings recording;
  for (const BearingMeasurement* measurement : bearings)
    recording[measurement->station].push_back(*measurement);
  return recording;
}

void require_reasonable(double rate_hz, double span_s) {
  constexpr double kMostEpochs = 10e6;
  if (!std::isfinite(rate_hz)) throw std::invalid_argument("the rate is not a finite number");
  if (rate_hz > 0.0 && span_s * rate_hz > kMostEpochs) {
    std::ostringstream what;
    what << "a rate of " << rate_hz << " Hz over " << span_s << " s makes more than " << kMostEpochs
         << " epochs";
    throw std::invalid_argument(what.str());
  }
}

std::vector<std::int64_t> epochs_of(const BearingPointers& bearings, double rate_hz) {
  std::vector<std::int64_t> epochs;
  epochs.reserve(bearings.size());
  for (const BearingMeasurement* measurement : bearings) epochs.push_back(measurement->utime_us);
  epochs.erase(std::unique(epochs.begin(), epochs.end()), epochs.end());
  if (epochs.empty()) return epochs;
  require_reasonable(rate_hz, static_cast<double>(epochs.back() - epochs.front()) * 1e-6);
  if (rate_hz <= 0.0) return epochs;
  std::vector<std::int64_t> grid;
  for (std::int64_t i = 0;; ++i) {
    const auto offset_us = std::llround(static_cast<double>(i) * 1e6 / rate_hz);
    if (epochs.front() + offset_us > epochs.back()) return grid;
    grid.push_back(epochs.front() + offset_us);
  }
}

// Mean square angular speed over steps that are long compared with the noise [rad^2/s^2].
double mean_square_speed(const std::vector<const BearingMeasurement*>& bearings) {
  constexpr double kLeastStep = 10.0, kLongestS = 2.0;  // in sigmas
  double sum = 0.0, span = 0.0;
  const BearingMeasurement* from = bearings.front();
  for (const BearingMeasurement* to : bearings) {
    const double step_s = static_cast<double>(to->utime_us - from->utime_us) * 1e-6;
    const double angle = angle_between(direction_ecef(from->sight), direction_ecef(to->sight));
    const double noise = std::sqrt(to->sight.covariance_white.trace());
    if (step_s <= 0.0 || (angle < kLeastStep * noise && step_s < kLongestS)) continue;
    from = to;
    if (step_s > 2.0 * kLongestS) continue;  // a gap
    sum += angle * angle / step_s;
    span += step_s;
  }
  return span > 0.0 ? sum / span : 0.0;
}

// The track of the one object, and the stations that point elsewhere.
class Recording {
 public:
  explicit Recording(const OfflineConfig& config)
      : track_(config.fusion.tracks), pointing_(config.fusion.pointing), tell_(config.tell) {}

  void add(const BearingMeasurement& measurement) {
    if (tell_) tell_();
    track_.advance(measurement.utime_us);
    if (!associate({&measurement, 1}, track_, pointing_).front().newly_so) return;
    beside_.try_emplace(measurement.station, pointing_.quarantine(measurement.station));
  }
  void advance(std::int64_t utime_us) { track_.advance(utime_us); }
  const RecordedTrack& track() const { return track_; }
  const std::map<std::string, std::string>& beside() const { return beside_; }

 private:
  RecordedTrack track_;
  PointingMonitor pointing_;
  std::function<void()> tell_;
  std::map<std::string, std::string> beside_;
};

FusedTarget target_of(std::int64_t epoch_us, const char* estimator, Located located) {
  FusedTarget target;
  target.utime_us = epoch_us;
  target.target_id = 1;
  target.estimator = estimator;
  target.estimate = std::move(located.estimate);
  target.stations = std::move(located.stations);
  return target;
}

// Passes on the targets with a position; counts the others' reasons.
struct Fixes {
  const std::function<void(FusedTarget)>& take;
  Unlocated& unlocated;

  void add(std::int64_t epoch_us, const char* estimator, Located located) {
    const Solution solution = located.estimate.solution;
    if (solution == Solution::kOk) {
      take(target_of(epoch_us, estimator, std::move(located)));
    } else {
      ++unlocated[solution];
    }
  }
};

using Beside = std::map<std::string, std::string>;

// Runs the filter some time past the instant, and predicts back to it.
Beside filtered(const BearingPointers& bearings, const std::vector<std::int64_t>& epochs,
                Estimator& estimator, const OfflineConfig& config, Fixes fixes) {
  Recording recording(config);
  auto next = bearings.begin();
  const std::int64_t ahead_us = std::llround(1e6 * config.look_ahead_s);
  for (const std::int64_t epoch_us : epochs) {
    const std::int64_t last_us = std::min(epoch_us + ahead_us, bearings.back()->utime_us);
    for (; next != bearings.end() && (*next)->utime_us <= last_us; ++next) {
      recording.add(**next);
    }
    recording.advance(last_us);
    const Track* const track = recording.track().located();
    if (track == nullptr) {
      ++fixes.unlocated[recording.track().why_none(last_us)];
      continue;
    }
    const TrackView view{track->bearings, recording.track().errors(), &track->filter};
    fixes.add(epoch_us, estimator.name(), estimator.locate(view, epoch_us));
  }
  for (; next != bearings.end(); ++next) recording.add(**next);
  return recording.beside();
}

// The estimators without memory use the whole recording.
Beside interpolating(const BearingPointers& bearings, const std::vector<std::int64_t>& epochs,
                     Estimator& estimator, const OfflineConfig& config, Fixes fixes) {
  Recording run(config);
  for (const BearingMeasurement* measurement : bearings) run.add(*measurement);
  const StationBearings recording = by_station(bearings);
  for (const std::int64_t epoch_us : epochs) {
    fixes.add(epoch_us, estimator.name(),
              estimator.locate({recording, run.track().errors()}, epoch_us));
  }
  return run.beside();
}

Beside smoothed(const BearingPointers& bearings, const std::vector<std::int64_t>& epochs,
                const OfflineConfig& config, Fixes fixes) {
  KnownStations known;
  Beside beside;
  {
    Recording run(config);
    for (const BearingMeasurement* measurement : bearings) run.add(*measurement);
    known.errors = run.track().errors();
    beside = run.beside();
  }
  for (const auto& [station, why] : beside) known.beside.insert(station);
  const SmootherOutput output{
      [&](Smoothed fix) { fixes.add(fix.utime_us, "filter", std::move(fix.located)); }, config.tell,
      config.workers};
  smooth(bearings, epochs, config.fusion.tracks, known, output);
  return beside;
}

}  // namespace

void guess_clocks(const MutableBearings& measurements) {
  constexpr double kNoises = 0.5, kHalfAFrameS = 0.02;
  std::map<std::string, BearingPointers> stations;
  for (const BearingMeasurement* measurement : measurements)
    stations[measurement->station].push_back(measurement);
  std::map<std::string, double> speeds;
  for (auto& [name, bearings] : stations) {
    std::ranges::stable_sort(bearings, {}, [](const BearingMeasurement* s) { return s->utime_us; });
    speeds[name] = std::sqrt(mean_square_speed(bearings));
  }
  for (BearingMeasurement* measurement : measurements) {
    const double noise = std::sqrt(measurement->sight.covariance_white.trace() / 2.0);
    const double speed = speeds.at(measurement->station);
    measurement->clock_sd_s = std::min(kHalfAFrameS, kNoises * noise / std::max(1e-9, speed));
  }
}

void guess_clocks(std::vector<BearingMeasurement>& measurements) {
  MutableBearings pointers;
  for (BearingMeasurement& measurement : measurements) pointers.push_back(&measurement);
  guess_clocks(pointers);
}

OfflineReport fuse_offline(const BearingPointers& measurements, const OfflineConfig& config,
                           const std::function<void(FusedTarget)>& take) {
  const auto estimator = make_estimator(config.estimator, config.fusion.estimators);
  if (!estimator) throw std::invalid_argument("unknown estimator " + config.estimator);
  const bool is_filter = config.estimator == "filter";
  if (config.smooth && !is_filter) throw std::invalid_argument("only the filter can be smoothed");
  OfflineReport report;
  const BearingPointers bearings =
      in_order(measurements, config.fusion.admission.min_belief, report.unused);
  const std::vector<std::int64_t> epochs = epochs_of(bearings, config.rate_hz);
  const Fixes fixes{take, report.unlocated};
  report.beside = config.smooth ? smoothed(bearings, epochs, config, fixes)
                  : is_filter   ? filtered(bearings, epochs, *estimator, config, fixes)
                                : interpolating(bearings, epochs, *estimator, config, fixes);
  return report;
}

std::vector<FusedTarget> fuse_offline(const std::vector<BearingMeasurement>& measurements,
                                      const OfflineConfig& config, OfflineReport* report) {
  std::vector<FusedTarget> targets;
  const OfflineReport found =
      fuse_offline(pointers_to(measurements), config,
                   [&](FusedTarget target) { targets.push_back(std::move(target)); });
  if (report != nullptr) *report = found;
  return targets;
}

}  // namespace ols::fusion
