#include "console/messages_cues.h"

#include "command/messages.h"
#include "console/rounded.h"

namespace ols::console {

Json cues_of(const BusMessage& message) {
  constexpr std::size_t kMostCues = 64;
  Json cues = Json::array();
  const auto said = command::heard_cues(message);
  if (!said) return cues;
  for (const command::FusionCue& cue : said->cues) {
    if (cues.size() >= kMostCues) break;
    cues.push_back({{"id", cue.id},
                    {"label", cue.label},
                    {"state", cue.state},
                    {"target", cue.target_id == 0 ? "" : std::to_string(cue.target_id)},
                    {"age_s", rounded(cue.age_s, 1)},
                    {"latitude_deg", rounded(cue.latitude_deg, 8)},
                    {"longitude_deg", rounded(cue.longitude_deg, 8)},
                    {"height_m", rounded(cue.height_m, 1)},
                    {"horizontal_sd_m", rounded(cue.horizontal_sd_m, 1)},
                    {"vertical_sd_m", rounded(cue.vertical_sd_m, 1)}});
  }
  return cues;
}

}  // namespace ols::console
