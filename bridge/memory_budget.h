// Limits of the memory for waiting messages. These limits, the program itself and its tables of
// names together must stay below MemoryMax in systemd/units/ols-bridge.service;
// tests/lint/test_units.py checks this.
#pragma once

#include <cstddef>

namespace ols::bridge {

// The first limit is for the queue of the bus, the second for all subscriptions at the server
// together. Each holds one second of traffic of a thousand stations. The NATS library needs twice
// the memory of the messages themselves.
inline constexpr std::size_t kBusQueueBytes = 24'000'000;
inline constexpr std::size_t kNetworkQueueBytes = 24'000'000;

}  // namespace ols::bridge
