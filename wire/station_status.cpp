#include "wire/station_status.h"

#include <algorithm>

#include "base/text/plain_text.h"
#include "ols_msg/bearing_t.hpp"
#include "wire/read.h"

namespace ols::wire {

std::optional<ols_msg::station_status_t> heard_status(const BusMessage& message) {
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
  using M = ols_msg::station_status_t;
  switch (state) {
    case M::STATE_IDLE:
      return "idle";
    case M::STATE_MANUAL:
      return "manual";
    case M::STATE_TRACKING:
      return "tracking";
    case M::STATE_COASTING:
      return "coasting";
    case M::STATE_LOST:
      return "lost";
    case M::STATE_SLEWED:
      return "slewed";
    case M::STATE_STOPPED:
      return "stopped";
    case M::STATE_EMERGENCY:
      return "emergency";
    default:
      return "unknown";
  }
}

bool is_stopped(std::int8_t state) {
  using M = ols_msg::station_status_t;
  return state == M::STATE_STOPPED || state == M::STATE_EMERGENCY;
}

const char* device_name(std::int8_t device) {
  using M = ols_msg::station_status_t;
  switch (device) {
    case M::DEVICE_ABSENT:
      return "absent";
    case M::DEVICE_STARTING:
      return "starting";
    case M::DEVICE_OK:
      return "ok";
    case M::DEVICE_FAULT:
      return "fault";
    default:
      return "unknown";
  }
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
  using M = ols_msg::station_status_t;
  return source == M::POSE_SURVEYED ? "surveyed" : source == M::POSE_SENSOR ? "sensor" : "unknown";
}

const char* clock_name(std::int8_t state) {
  using M = ols_msg::bearing_t;
  return state == M::CLOCK_SYNCHRONISED     ? "synchronised"
         : state == M::CLOCK_UNSYNCHRONISED ? "unsynchronised"
                                            : "unknown";
}

const char* calibration_name(std::int8_t state) {
  using M = ols_msg::station_status_t;
  switch (state) {
    case M::CALIBRATION_IN_USE:
      return "in use";
    case M::CALIBRATION_REFUSED:
      return "refused";
    case M::CALIBRATION_DOUBTED:
      return "doubted";
    default:
      return "none";
  }
}

}  // namespace ols::wire
