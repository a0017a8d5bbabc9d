#include "base/trust/messages_trust.h"

#include <exception>

#include "base/bus/message_stamp.h"
#include "ols_msg/ptu_command_t.hpp"

namespace ols::trust {
namespace {

template <class Message>
Message telling(const std::string& text, std::int64_t boot_id, std::int64_t sequence,
                std::int64_t utime_us) {
  Message message;
  stamp_message(message, utime_us, boot_id, sequence);
  message.text = text;
  return message;
}

// Like decode_exactly() of base/bus/lcm_bus.h, which this library cannot include.
template <class Message>
bool decode(Bytes payload, Message& message) {
  const int size = static_cast<int>(payload.size());
  try {
    return message.decode(payload.data(), 0, size) == size;
  } catch (const std::exception&) {
    return false;
  }
}

template <class Message>
std::optional<std::string> text_from(Bytes payload) {
  Message message;
  if (!decode(payload, message)) return std::nullopt;
  if (message.schema_version != Message::SCHEMA_VERSION) return std::nullopt;
  return message.text;
}

}  // namespace

ols_msg::trust_list_t to_message(const std::string& list, std::int64_t boot_id,
                                 std::int64_t sequence, std::int64_t utime_us) {
  return telling<ols_msg::trust_list_t>(list, boot_id, sequence, utime_us);
}

ols_msg::site_settings_t to_settings_message(const std::string& settings, std::int64_t boot_id,
                                             std::int64_t sequence, std::int64_t utime_us) {
  return telling<ols_msg::site_settings_t>(settings, boot_id, sequence, utime_us);
}

std::optional<std::string> list_from(Bytes payload) {
  return text_from<ols_msg::trust_list_t>(payload);
}

std::optional<std::string> settings_from(Bytes payload) {
  return text_from<ols_msg::site_settings_t>(payload);
}

bool is_stop(Bytes payload) {
  ols_msg::ptu_command_t command;
  return decode(payload, command) && command.command == ols_msg::ptu_command_t::COMMAND_STOP;
}

}  // namespace ols::trust
