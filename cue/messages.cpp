#include "cue/messages.h"

#include <algorithm>

#include "base/bus/message_stamp.h"

namespace ols::cues {

ols_msg::cue_t to_message(const LiveCue& cue, const Stamp& stamp) {
  ols_msg::cue_t message{};
  stamp_message(message, stamp.utime_us, stamp.boot_id, stamp.sequence);
  message.id = cue.id;
  message.label = cue.label;
  message.state_utime = cue.utime_us;
  message.latitude_deg = cue.latitude_deg;
  message.longitude_deg = cue.longitude_deg;
  message.height_m = cue.height_m;
  message.horizontal_sd_m = cue.horizontal_sd_m;
  message.vertical_sd_m = cue.vertical_sd_m;
  std::ranges::copy(cue.velocity_enu_m_s, message.velocity_enu_m_s);
  message.velocity_sd_m_s = cue.velocity_sd_m_s;
  return message;
}

}  // namespace ols::cues
