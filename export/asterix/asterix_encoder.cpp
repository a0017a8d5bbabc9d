#include "export/asterix/asterix_encoder.h"

#include <algorithm>

namespace ols::exports {

std::optional<int> AsterixEncoder::sensor(const std::string& station) const {
  const auto found = std::ranges::find(settings_.stations, station);
  if (found == settings_.stations.end()) return std::nullopt;
  return settings_.sic + 1 + static_cast<int>(found - settings_.stations.begin());
}

Packets AsterixEncoder::encode(const Target& target) {
  const std::uint16_t number = numbers_.of(target.uid, target.id);
  if (target.state == TrackState::kEnded) numbers_.release(target.uid);
  return {{target.uid, cat062(target, number, settings_)}};
}

Packets AsterixEncoder::encode(const Station& station) {
  const auto code = sensor(station.name);
  if (!code) return {};
  return {{station.uid, cat063(station, *code, settings_)}};
}

Packets AsterixEncoder::encode(const Line& line) {
  const auto code = sensor(line.station);
  if (!code) return {};
  return {{line.uid, cat015(line, *code, settings_)}};
}

Packets AsterixEncoder::due(std::int64_t utime_us) {
  return {{"service", cat065(utime_us, settings_)}};
}

}  // namespace ols::exports
