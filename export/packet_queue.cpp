#include "export/packet_queue.h"

#include <iterator>
#include <utility>

namespace ols::exports {

void PacketQueue::put(Packet packet) {
  waiting_.push_back(std::move(packet));
  const auto added = std::prev(waiting_.end());
  if (!added->subject.empty()) {
    OfSubject& of = of_[added->subject];
    if (of.waiting == 2) {
      waiting_.erase(of.newest);
      ++displaced_;
    } else {
      ++of.waiting;
    }
    of.newest = added;
  }
  if (waiting_.size() <= most_) return;
  take();
  ++displaced_;
}

std::optional<Packet> PacketQueue::take() {
  if (waiting_.empty()) return std::nullopt;
  Packet packet = std::move(waiting_.front());
  waiting_.pop_front();
  const auto of = of_.find(packet.subject);
  if (of != of_.end() && --of->second.waiting == 0) of_.erase(of);
  return packet;
}

void PacketQueue::clear() {
  displaced_ += waiting_.size();
  waiting_.clear();
  of_.clear();
}

}  // namespace ols::exports
