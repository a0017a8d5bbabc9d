// The packets that wait for a receiver. Their number is limited; a newer packet replaces an older
// one of the same subject. Pure.
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

  // Replaces a waiting packet of the same subject; if there is none, adds the packet at the end. If
  // there are then too many, drops the oldest.
  void put(Packet packet);
  std::optional<Packet> take();
  void clear();

  std::size_t size() const { return waiting_.size(); }
  std::uint64_t displaced() const {
    return displaced_;
  }  // number of packets never sent; only
     // increases

 private:
  std::size_t most_;
  std::deque<Packet> waiting_;
  std::uint64_t taken_ = 0;                                // number of the first waiting packet
  std::unordered_map<std::string, std::uint64_t> number_;  // by subject: number of the waiting
                                                           // packet
  std::uint64_t displaced_ = 0;
};

}  // namespace ols::exports
