#include "console/messages_cues.h"

#include <cmath>

#include "command/messages.h"

namespace ols::console {
namespace {

Json rounded(double value, double scale) {
  if (!std::isfinite(value) || std::abs(value) > 1e15) return nullptr;
  return std::round(value * scale) / scale;
}

}  // namespace

Json cues_of(const BusMessage& message) {
  constexpr std::size_t kMostCues = 64;
  Json cues = Json::array();
  const auto said = command::heard_cues(message);
  if (!said) return cues;
  for (const command::CueSaid& cue : said->cues) {
    if (cues.size() >= kMostCues) break;
    cues.push_back({{"id", cue.id},
                    {"label", cue.label},
                    {"state", cue.state},
                    {"target", cue.target_id == 0 ? "" : std::to_string(cue.target_id)},
                    {"age_s", rounded(cue.age_s, 10.0)},
                    {"latitude_deg", rounded(cue.latitude_deg, 1e8)},
                    {"longitude_deg", rounded(cue.longitude_deg, 1e8)},
                    {"height_m", rounded(cue.height_m, 10.0)},
                    {"horizontal_sd_m", rounded(cue.horizontal_sd_m, 10.0)},
                    {"vertical_sd_m", rounded(cue.vertical_sd_m, 10.0)}});
  }
  return cues;
}

}  // namespace ols::console
