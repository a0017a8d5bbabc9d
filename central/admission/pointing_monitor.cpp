#include "central/admission/pointing_monitor.h"

#include <algorithm>
#include <cmath>

#include "conditions/alarms.h"
#include "geometry/angles.h"

namespace ols::fusion {

void PointingMonitor::hear(const std::string& name, std::int64_t utime_us, bool explained,
                           const std::optional<Eigen::Vector2d>& off_rad) {
  if (!explained && !off_rad) return lapse(name, utime_us);
  Station& station = stations_[name];
  if (station.newest_us == 0) station.first_us = station.newest_us = utime_us;
  const double since_s = static_cast<double>(utime_us - station.newest_us) * 1e-6;
  const double decay = std::exp(-std::max(0.0, since_s) / config_.memory_s);
  station.newest_us = std::max(station.newest_us, utime_us);
  station.bearings = station.bearings * decay + 1.0;
  station.explained = station.explained * decay + (explained ? 1.0 : 0.0);
  const bool near = !explained && off_rad->norm() <= config_.most_off_rad;
  station.judged = station.judged * decay + (near ? 1.0 : 0.0);
  const Eigen::Vector2d off = near ? *off_rad : Eigen::Vector2d(Eigen::Vector2d::Zero());
  station.sum = (station.sum * decay + off).eval();
  station.squared = station.squared * decay + off.squaredNorm();
  judge(name, station);
}

// Without a target there is no reference to compare with.
void PointingMonitor::lapse(const std::string& name, std::int64_t utime_us) {
  const auto found = stations_.find(name);
  if (found == stations_.end()) return;
  const double since_s = static_cast<double>(utime_us - found->second.newest_us) * 1e-6;
  if (since_s > config_.lapse_s) stations_.erase(found);
}

void PointingMonitor::judge(const std::string& name, Station& station) const {
  const double share = station.explained / station.bearings;
  if (share >= config_.released_share) station.quarantine = {};
  const double watched_s = static_cast<double>(station.newest_us - station.first_us) * 1e-6;
  if (share > config_.explained_share || station.judged < config_.least_bearings ||
      station.judged < station.bearings / 2.0 || watched_s < config_.memory_s) {
    return;
  }
  const Eigen::Vector2d mean = station.sum / station.judged;
  const double off = mean.norm();
  const double spread =
      std::sqrt(std::max(0.0, station.squared / station.judged - mean.squaredNorm()));
  if (off < config_.least_off_rad || spread > config_.spread * off) return;
  station.quarantine = alarm::station_off_target(name, degrees(off));
}

const Alarm& PointingMonitor::quarantine(const std::string& station) const {
  static const Alarm kNone;
  const auto found = stations_.find(station);
  return found == stations_.end() ? kNone : found->second.quarantine;
}

}  // namespace ols::fusion
