// One direction of a relay between two buses: loses, duplicates, delays and reorders messages at
// random. Pure. What happens to the n-th message depends only on the seed, not on the times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace ols::sim {

struct Impairments {
  double loss = 0.0, duplicate = 0.0, reorder = 0.0;  // probabilities, per message
  double delay_s = 0.0;                               // of every message
  double reorder_s = 0.05;      // extra delay of a reordered message; later ones overtake it
  std::size_t capacity = 1000;  // max messages in transit; further ones are dropped
};

struct Packet {
  std::string channel;
  std::vector<std::uint8_t> data;
};

struct RelayCounts {
  std::uint64_t received = 0, lost = 0, duplicated = 0, reordered = 0, overflowed = 0, sent = 0;
};

class RelayQueue {
 public:
  RelayQueue(const Impairments& impairments, std::uint64_t seed);

  void offer(Packet packet, double time_s);
  // The messages due by now, in the order of their due times.
  std::vector<Packet> take(double time_s);

  std::size_t size() const { return queue_.size(); }
  const RelayCounts& counts() const { return counts_; }

 private:
  bool draw(double probability);
  void put(Packet packet, double due_s);

  Impairments impairments_;
  std::mt19937_64 random_;
  std::uint64_t number_ = 0;  // keeps messages of one instant in order
  std::map<std::pair<double, std::uint64_t>, Packet> queue_;
  RelayCounts counts_;
};

}  // namespace ols::sim
