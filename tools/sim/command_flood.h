// Forged commands to one station, as somebody sends them who wants its operator unheard. None is
// one that the station may obey: stale, played again, from the future, for another station, of
// another schema, damaged, out of limits (these pass for fresh, from ever new senders with stamps
// somewhat ahead), slews with the greatest of sequences beside an operator who has precedence. What
// a fresh and well-formed command does needs no flood: without signatures it is obeyed. Pure;
// deterministic by its seed and the times it is given.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "tools/sim/relay_queue.h"

namespace ols::sim {

class CommandFlood {
 public:
  CommandFlood(std::string station, std::uint64_t seed);

  // `utime_us`: UTC since 1970, by which stamps are fresh or stale.
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
