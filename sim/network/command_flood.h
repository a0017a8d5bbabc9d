// Forged commands to one station, from an attacker who wants to keep the operator out. Pure; the
// same seed and times give the same commands.
//
// A station must refuse nearly all of these commands. Some are stale, replayed, stamped in the
// future, meant for another station, of another schema or damaged. Others look fresh, with a new
// sender each time, but point beyond the limits, or are slews with the largest sequence number.
// About one command in twenty is fresh and well-formed: without signatures the station obeys it,
// and its unit swings from side to side.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "sim/network/relay_queue.h"

namespace ols::sim {

// The pan angle of the well-formed commands at this instant: +kSwing_rad and -kSwing_rad in turn,
// for kSwing_us each.
constexpr double kSwing_rad = 1.4;
constexpr std::int64_t kSwing_us = 4'000'000;
double swing_goal_rad(std::int64_t utime_us);

class CommandFlood {
 public:
  CommandFlood(std::string station, std::uint64_t seed);

  // The next command. `utime_us`: UTC now; the stamps are relative to it.
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
