// Forged commands to one station, from an attacker who wants to keep the operator out. Pure;
// deterministic by its seed and the times it is given.
//
// Every station must refuse most of them: stale, replayed, from the future, for another station, of
// another schema, damaged, out of limits (these look fresh: always new senders, stamps somewhat
// ahead), slews with maximum sequence numbers. One in eighteen is fresh and well-formed. Without
// signatures the station obeys it, and its unit points to alternate sides.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "sim/network/relay_queue.h"

namespace ols::sim {

// Where the obeyed commands point at this instant: alternately +- kSwing_rad, for kSwing_us each.
constexpr double kSwing_rad = 1.4;
constexpr std::int64_t kSwing_us = 4'000'000;
double swing_goal_rad(std::int64_t utime_us);

class CommandFlood {
 public:
  CommandFlood(std::string station, std::uint64_t seed);

  // `utime_us`: UTC since 1970, which decides whether stamps are fresh or stale.
  Packet next(std::int64_t utime_us);

 private:
  template <class Message>
  void address(Message& message, std::int64_t utime_us);
  template <class Message>
  bool spoil(Message& message, int how);
  Packet ptu(std::int64_t utime_us);
  Packet slew(std::int64_t utime_us);
  Packet designate(std::int64_t utime_us);
  int below(int limit);

  std::string station_;
  std::mt19937_64 random_;
};

}  // namespace ols::sim
