// Sends incidents on the bus, as incident_t.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bus/lcm_bus.h"
#include "console/incidents/incident_book.h"

namespace ols::console {

// Sends each incident that has changed. Repeats an incident once a second as long as its target is
// inside, because a message may be lost, and a program may start later.
class IncidentSender {
 public:
  explicit IncidentSender(std::int64_t boot_id) : boot_id_(boot_id) {}

  // False if the network is down.
  bool send(LcmBus& bus, const IncidentWatch& watch, const IncidentBook::News& news,
            std::int64_t utime_us);

 private:
  std::int64_t boot_id_;
  std::int64_t sequence_ = 0;
  std::int64_t repeated_us_ = 0;
};

}  // namespace ols::console
