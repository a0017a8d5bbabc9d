#include "wire/station_status.h"

#include <algorithm>
#include <array>

#include "base/bus/message_code.h"
#include "base/text/plain_text.h"
#include "wire/read.h"

namespace ols::wire {

std::optional<ols_msg::station_status_t> decode_status(const BusMessage& message) {
  // Channel names are printable (base/bus/bus_datagram.h), hence the station's id too.
  auto status = read<ols_msg::station_status_t>(kStatusChannel, message);
  if (!status) return std::nullopt;
  status->last_error = plain_text(status->last_error);
  for (auto* texts : {&status->device_name, &status->device_text, &status->alarm, &status->alarm_id,
                      &status->alarm_parameter_name, &status->alarm_parameter_value,
                      &status->reading_name, &status->counter_name}) {
    for (std::string& text : *texts) text = plain_text(text);
  }
  return status;
}

double counter(const ols_msg::station_status_t& status, const std::string& name) {
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    if (status.counter_name[i] == name) return status.counter_value[i];
  }
  return 0.0;
}

const char* state_name(std::int8_t state) {
  return word_of_code(state, std::array{"idle", "manual", "tracking", "coasting", "lost", "slewed",
                                        "stopped", "emergency", "hidden"});
}

bool is_stopped(std::int8_t state) {
  using M = ols_msg::station_status_t;
  return state == M::STATE_STOPPED || state == M::STATE_EMERGENCY;
}

const char* device_name(std::int8_t device) {
  return word_of_code(device, std::array{"absent", "starting", "ok", "fault"});
}

const char* device_state(const ols_msg::station_status_t& status, const std::string& name) {
  for (std::size_t i = 0; i < status.device_name.size(); ++i) {
    if (status.device_name[i] == name) return device_name(status.device_state[i]);
  }
  return "-";
}

std::string software(const ols_msg::station_status_t& status) {
  constexpr std::size_t kLongest = 40;
  const auto named = std::ranges::find(status.device_name, "software");
  if (named == status.device_name.end()) return "-";
  const auto at = static_cast<std::size_t>(named - status.device_name.begin());
  return plain_text(status.device_text[at].substr(0, kLongest));
}

const char* source_name(std::int8_t source) {
  return word_of_code(source, std::array{"unknown", "surveyed", "sensor"});
}

const char* clock_name(std::int8_t state) {
  return word_of_code(state, std::array{"unknown", "synchronised", "unsynchronised"});
}

const char* calibration_name(std::int8_t state) {
  return word_of_code(state, std::array{"none", "in use", "refused", "doubted"}, "none");
}

}  // namespace ols::wire
