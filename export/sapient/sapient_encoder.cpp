#include "export/sapient/sapient_encoder.h"

#include <cmath>

namespace ols::exports {
namespace {

constexpr std::size_t kMostStations = 200;
constexpr double kTurn_s = 1.0;  // the step in which turns come

}  // namespace

Packets SapientEncoder::encode(const Target& target) {
  const auto instant_us = scan_.instant_of(target);
  if (!instant_us) return {};
  return {{target.uid, sapient_detection(settings_, target, *instant_us)}};
}

Packets SapientEncoder::encode(const Station& station) {
  if (stations_.size() < kMostStations || stations_.contains(station.name)) {
    stations_[station.name] = station;
  }
  return {};
}

Packets SapientEncoder::due(std::int64_t utime_us) {
  // A clock that was set back must not silence the node.
  const double early_s = 1e-6 * static_cast<double>(due_us_ - utime_us);
  if (early_s > kTurn_s / 2.0 && early_s <= settings_.status_s) return {};
  due_us_ = utime_us + std::llround(1e6 * settings_.status_s);
  std::erase_if(stations_, [&](const auto& entry) {
    return std::abs(1e-6 * static_cast<double>(utime_us - entry.second.utime_us)) >
           kStationSilent_s;
  });
  std::vector<Station> stations;
  for (const auto& [name, station] : stations_) stations.push_back(station);
  return {{"status", sapient_status(settings_, stations, utime_us)}};
}

void SapientEncoder::begin_again() {
  scan_.begin_again();
  due_us_ = 0;
}

}  // namespace ols::exports
