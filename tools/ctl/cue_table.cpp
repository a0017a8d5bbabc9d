#include "tools/ctl/cue_table.h"

#include <algorithm>

#include "conditions/printed.h"
#include "wire/fusion_status.h"

namespace ols::ctl {

std::string cue_table(const ols_msg::fusion_status_t& s, const TargetClasses& classes) {
  std::string table;
  if (!s.handover.empty()) table = "hand-over: " + s.handover + "\n";
  if (s.cue_id.empty()) return table + "no cues\n";
  table +=
      "cue                  state      target  class           age s   latitude deg  longitude deg "
      "  height m  "
      "1-sigma m  label\n";
  for (std::size_t i = 0; i < s.cue_id.size(); ++i) {
    const std::int64_t target = s.cue_target_id[i];
    const auto known = classes.find(target);
    const std::string row = printed(
        " %-9s %7s  %-15s %5.1f  %13.6f  %13.6f  %9.1f  %4.0f %4.0f  ",
        wire::cue_state_name(s.cue_state[i]), target == 0 ? "-" : std::to_string(target).c_str(),
        known == classes.end() ? "-" : known->second.c_str(), s.cue_age_s[i], s.cue_latitude_deg[i],
        s.cue_longitude_deg[i], s.cue_height_m[i], s.cue_horizontal_sd_m[i],
        s.cue_vertical_sd_m[i]);
    std::string name = s.cue_id[i];
    name.resize(std::max<std::size_t>(20, name.size()), ' ');
    table.append(name).append(row).append(s.cue_label[i]).append("\n");
  }
  return table;
}

}  // namespace ols::ctl
