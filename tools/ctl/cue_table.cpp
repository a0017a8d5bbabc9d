#include "tools/ctl/cue_table.h"

#include <algorithm>
#include <cstdio>

namespace ols::ctl {

std::string cue_table(const command::FusionCues& said) {
  if (said.cues.empty()) return "no cues\n";
  std::string table =
      "cue                  state      target   age s   latitude deg  longitude deg   height m  "
      "1-sigma m  label\n";
  for (const command::FusionCue& cue : said.cues) {
    char row[160];
    std::snprintf(
        row, sizeof row, " %-9s %7s %7.1f  %13.6f  %13.6f  %9.1f  %4.0f %4.0f  ", cue.state.c_str(),
        cue.target_id == 0 ? "-" : std::to_string(cue.target_id).c_str(), cue.age_s,
        cue.latitude_deg, cue.longitude_deg, cue.height_m, cue.horizontal_sd_m, cue.vertical_sd_m);
    std::string name = cue.id;
    name.resize(std::max<std::size_t>(20, name.size()), ' ');
    table.append(name).append(row).append(cue.label).append("\n");
  }
  return table;
}

}  // namespace ols::ctl
