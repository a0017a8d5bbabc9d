// Foreign messages as a shared or hostile network has them: unknown channels, the site's own
// channels with rubbish in them, with a right fingerprint and a damaged rest, and for stations that
// do not exist. Pure; deterministic by its seed.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "sim/relay_queue.h"

namespace ols::sim {

class Flood {
 public:
  // `names`: how many different foreign channels and stations there are. (liblcm remembers each
  // name that it has ever heard, with or without a subscriber.)
  Flood(std::vector<std::string> stations, int names, std::uint64_t seed);

  Packet next();

 private:
  int below(int limit);
  std::vector<std::uint8_t> rubbish(int most_bytes);
  std::string foreign_channel();
  Packet damaged();

  std::vector<std::string> stations_;
  int names_;
  std::mt19937_64 random_;
};

// A message on a channel that nobody knows; each number has a name of its own, of ordinary length.
Packet unknown_channel(std::uint64_t number);

}  // namespace ols::sim
