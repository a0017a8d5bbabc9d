// What waits for a receiver: bounded, and the newest wins. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>

#include "export/encoder.h"

namespace ols::exports {

class PacketQueue {
 public:
  explicit PacketQueue(std::size_t most = 1000) : most_(most) {}

  // In the place of one of the same subject that still waits; else behind all, and if there are too
  // many, in place of the oldest.
  void put(Packet packet);
  std::optional<Packet> take();
  void clear();

  std::size_t size() const { return waiting_.size(); }
  std::uint64_t displaced() const { return displaced_; }  // never sent; only goes up

 private:
  std::size_t most_;
  std::deque<Packet> waiting_;
  std::uint64_t taken_ = 0;                                // number of the first that waits
  std::unordered_map<std::string, std::uint64_t> number_;  // by subject, of what waits
  std::uint64_t displaced_ = 0;
};

}  // namespace ols::exports
