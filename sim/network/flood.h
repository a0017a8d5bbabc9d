// Foreign messages, as on a shared or hostile network. Some are on unknown channels. Others are on
// the site's own channels: random bytes, damaged messages with a valid fingerprint, or messages for
// stations that do not exist. Pure; the same seed gives the same messages.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "sim/network/relay_queue.h"

namespace ols::sim {

class Flood {
 public:
  // `names`: number of different foreign channels and stations. (liblcm keeps each name that it has
  // ever received, with or without a subscriber.)
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

// A message on an unknown channel. Each number gives another channel name of ordinary length.
Packet unknown_channel(std::uint64_t number);

}  // namespace ols::sim
