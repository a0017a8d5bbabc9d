#include "export/packet_queue.h"

#include <iterator>
#include <utility>

namespace ols::exports {

void PacketQueue::put(Packet packet) {
  if (const auto older = of_.find(packet.subject); older != of_.end()) {
    waiting_.erase(older->second);
    ++displaced_;
  }
  waiting_.push_back(std::move(packet));
  const auto added = std::prev(waiting_.end());
  if (!added->subject.empty()) of_[added->subject] = added;
  if (waiting_.size() <= most_) return;
  take();
  ++displaced_;
}

std::optional<Packet> PacketQueue::take() {
  if (waiting_.empty()) return std::nullopt;
  Packet packet = std::move(waiting_.front());
  of_.erase(packet.subject);
  waiting_.pop_front();
  return packet;
}

void PacketQueue::clear() {
  displaced_ += waiting_.size();
  waiting_.clear();
  of_.clear();
}

}  // namespace ols::exports
