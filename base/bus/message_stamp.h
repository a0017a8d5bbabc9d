// The fields with which every message begins, whatever its type.
#pragma once

#include <cstdint>

namespace ols {

// Sets these fields; `boot_id` and `sequence` are the sender's.
template <class Message>
void stamp_message(Message& message, std::int64_t utime_us, std::int64_t boot_id,
                   std::int64_t sequence) {
  message.utime = utime_us;
  message.schema_version = Message::SCHEMA_VERSION;
  message.boot_id = boot_id;
  message.sequence = sequence;
}

}  // namespace ols
