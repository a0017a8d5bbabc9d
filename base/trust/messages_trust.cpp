#include "base/trust/messages_trust.h"

#include <exception>

namespace ols::trust {

ols_msg::trust_list_t to_message(const std::string& list, std::int64_t boot_id,
                                 std::int64_t sequence, std::int64_t utime_us) {
  ols_msg::trust_list_t message;
  message.utime = utime_us;
  message.schema_version = ols_msg::trust_list_t::SCHEMA_VERSION;
  message.boot_id = boot_id;
  message.sequence = sequence;
  message.text = list;
  return message;
}

// As decode_exactly() of base/lcm_bus.h, which stands above this.
std::optional<std::string> list_from(Bytes payload) {
  ols_msg::trust_list_t message;
  const int size = static_cast<int>(payload.size());
  try {
    if (message.decode(payload.data(), 0, size) != size) return std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (message.schema_version != ols_msg::trust_list_t::SCHEMA_VERSION) return std::nullopt;
  return message.text;
}

}  // namespace ols::trust
