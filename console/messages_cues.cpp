#include "console/messages_cues.h"

#include <algorithm>

#include "console/rounded.h"
#include "wire/fusion_status.h"

namespace ols::console {

Json cues_of(const ols_msg::fusion_status_t& s) {
  constexpr std::size_t kMostCues = 64;
  Json cues = Json::array();
  for (std::size_t i = 0; i < std::min(s.cue_id.size(), kMostCues); ++i) {
    cues.push_back({{"id", s.cue_id[i]},
                    {"label", s.cue_label[i]},
                    {"state", wire::cue_state_name(s.cue_state[i])},
                    {"target", s.cue_target_id[i] == 0 ? "" : std::to_string(s.cue_target_id[i])},
                    {"age_s", rounded(s.cue_age_s[i], 1)},
                    {"latitude_deg", rounded(s.cue_latitude_deg[i], 8)},
                    {"longitude_deg", rounded(s.cue_longitude_deg[i], 8)},
                    {"height_m", rounded(s.cue_height_m[i], 1)},
                    {"horizontal_sd_m", rounded(s.cue_horizontal_sd_m[i], 1)},
                    {"vertical_sd_m", rounded(s.cue_vertical_sd_m[i], 1)}});
  }
  return cues;
}

}  // namespace ols::console
