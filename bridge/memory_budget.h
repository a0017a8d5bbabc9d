// The limits of the memory for waiting messages. Together with the program itself and its tables of
// names, they must be less than the MemoryMax of systemd/units/ols-bridge.service;
// tests/lint/test_units.py compares them.
#pragma once

#include <cstddef>

namespace ols::bridge {

// One limit is for the queue of the bus, the other for all subscriptions at the server together.
// Each holds one second of traffic of a thousand stations. The NATS library needs as much memory
// again around each message.
inline constexpr std::size_t kBusQueueBytes = 24'000'000;
inline constexpr std::size_t kNetworkQueueBytes = 24'000'000;

}  // namespace ols::bridge
