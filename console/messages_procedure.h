// Converts the messages of guided procedures (lcmtypes/procedure_t.lcm) to the console's own
// values.
#pragma once

#include <cstdint>
#include <optional>

#include "base/bus/lcm_bus.h"
#include "console/procedures.h"

namespace ols::console {

// nullopt for a message that cannot be decoded, has another schema, or does not name the station of
// its channel. Texts are made safe to show (base/text/plain_text.h).
std::optional<ReceivedProcedure> procedure_from(const BusMessage& message);

// Sends answers with one boot id, each with its own sequence number.
class AnswerSender {
 public:
  explicit AnswerSender(std::int64_t boot_id) : boot_id_(boot_id) {}
  // `utime_us`: this host's UTC. False if the network is down.
  bool send(LcmBus& bus, const ProcedureAnswer& answer, std::int64_t utime_us);

 private:
  std::int64_t boot_id_;
  std::int64_t sequence_ = 0;
};

}  // namespace ols::console
