#include "central/admission/clock_monitor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "central/measurement/time_span.h"
#include "conditions/alarms.h"
#include "geometry/median.h"

namespace ols::fusion {
namespace {

constexpr double kTighter = 0.7;  // of the limits; a quarantine ends only within this share
constexpr std::size_t kLeastStationsToCompare = 3;

}  // namespace

double ClockMonitor::common_offset_s(const Station& station) const {
  if (station.offsets_s.size() < static_cast<std::size_t>(config_.stamps)) return 0.0;
  const auto [least, greatest] = std::ranges::minmax(station.offsets_s);
  return std::clamp(0.0, least, greatest);
}

bool ClockMonitor::others_are_better(const std::string& station, const MessageTime& time) const {
  std::vector<double> errors_s;
  for (const std::string& other : time.delivering()) {
    const auto found = stations_.find(other);
    if (other != station && found != stations_.end()) errors_s.push_back(found->second.error_s);
  }
  return !errors_s.empty() && median(std::move(errors_s)) <= config_.error_limit_s;
}

Alarm ClockMonitor::judge(const std::string& name, const Station& station,
                          const MessageTime& time) const {
  const double limit = station.quarantine.empty() ? 1.0 : kTighter;
  if (station.error_s > limit * config_.error_limit_s && others_are_better(name, time)) {
    return alarm::station_clock_error(name, station.error_s);
  }
  if (time.delivering_count() < kLeastStationsToCompare) return {};
  const double offset_s = common_offset_s(station);
  if (offset_s > limit * config_.offset_limit_s) {
    return alarm::station_ahead(name, offset_s);
  }
  if (offset_s < -limit * config_.offset_limit_s && !station.synchronised) {
    return alarm::station_behind(name, -offset_s);
  }
  return {};
}

void ClockMonitor::hear(const BearingMeasurement& measurement, const MessageTime& time) {
  Station& station = stations_[measurement.station];
  station.error_s = measurement.clock_sd_s;
  station.synchronised = measurement.clock == StationClock::kSynchronised;
  const double offset_s = seconds(measurement.utime_us - time.middle_us());
  station.offsets_s.push_back(offset_s);
  if (station.offsets_s.size() > static_cast<std::size_t>(config_.stamps)) {
    station.offsets_s.pop_front();
  }
  const Alarm bad = judge(measurement.station, station, time);
  if (!bad.empty()) {
    station.quarantine = bad;
    station.bad_s = time.elapsed_s();
  } else if (time.elapsed_s() - station.bad_s > config_.release_s) {
    station.quarantine = {};
  }
}

const Alarm& ClockMonitor::quarantine(const std::string& station) const {
  static const Alarm kNone;
  const auto found = stations_.find(station);
  return found == stations_.end() ? kNone : found->second.quarantine;
}

double ClockMonitor::added_sd_s(const std::string& station) const {
  const auto found = stations_.find(station);
  if (found == stations_.end() || found->second.synchronised) return 0.0;
  return std::max(0.0, std::abs(common_offset_s(found->second)) - config_.usual_offset_s);
}

double ClockMonitor::offset_s(const std::string& station) const {
  const auto found = stations_.find(station);
  if (found == stations_.end()) return std::numeric_limits<double>::quiet_NaN();
  return common_offset_s(found->second);
}

}  // namespace ols::fusion
