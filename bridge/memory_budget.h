// What waits in memory at most. With what the program itself needs, and the books of names, it must
// be less than the MemoryMax of systemd/units/ols-bridge.service: tests/lint/test_units.py
// compares.
#pragma once

#include <cstddef>

namespace ols::bridge {

// Of the bus, and of all subscriptions at the server: each a second's worth of a thousand stations.
// The library needs as much again around each message.
inline constexpr std::size_t kBusQueueBytes = 24'000'000;
inline constexpr std::size_t kNetworkQueueBytes = 24'000'000;

}  // namespace ols::bridge
