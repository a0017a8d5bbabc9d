#include "wire/fusion_status.h"

#include <array>

#include "base/bus/message_code.h"
#include "base/text/plain_text.h"
#include "wire/read.h"

namespace ols::wire {

std::optional<ols_msg::fusion_status_t> decode_fusion_status(const BusMessage& message) {
  auto status = read<ols_msg::fusion_status_t>(kFusionStatusChannel, message);
  if (!status) return std::nullopt;
  status->last_error = plain_text(status->last_error);
  for (auto* texts : {&status->station, &status->quarantine, &status->counter_name, &status->alarm,
                      &status->alarm_id, &status->alarm_parameter_name,
                      &status->alarm_parameter_value, &status->cue_id, &status->cue_label}) {
    for (std::string& text : *texts) text = plain_text(text);
  }
  return status;
}

const char* cue_state_name(std::int8_t state) {
  return word_of_code(state, std::array{"waiting", "searched", "found", "forbidden"}, "forbidden");
}

}  // namespace ols::wire
