// The packets that wait for a receiver, in the order in which they were put: a receiver may refuse
// a packet whose time is earlier than that of the packet before it. Their number is limited. At
// most two packets of one subject wait: the older one keeps its place, so that each subject has its
// turn over a slow connection, and a newer packet replaces the other. Pure.
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <unordered_map>

#include "export/encoder.h"

namespace ols::exports {

class PacketQueue {
 public:
  explicit PacketQueue(std::size_t most = 1000) : most_(most) {}

  // Adds the packet at the end, and removes the second waiting packet of the same subject. If there
  // are then too many, drops the oldest.
  void put(Packet packet);
  std::optional<Packet> take();
  void clear();

  std::size_t size() const { return waiting_.size(); }
  std::uint64_t displaced() const { return displaced_; }  // packets never sent; only increases

 private:
  std::size_t most_;
  struct OfSubject {
    int waiting = 0;
    std::list<Packet>::iterator newest;
  };
  std::list<Packet> waiting_;
  std::unordered_map<std::string, OfSubject> of_;  // by subject
  std::uint64_t displaced_ = 0;
};

}  // namespace ols::exports
