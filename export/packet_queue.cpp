#include "export/packet_queue.h"

#include <utility>

namespace ols::exports {

void PacketQueue::put(Packet packet) {
  if (!packet.subject.empty()) {
    const auto [known, is_new] =
        number_.try_emplace(packet.subject, taken_ + static_cast<std::uint64_t>(waiting_.size()));
    if (!is_new) {
      waiting_[known->second - taken_] = std::move(packet);
      ++displaced_;
      return;
    }
  }
  waiting_.push_back(std::move(packet));
  if (waiting_.size() <= most_) return;
  take();
  ++displaced_;
}

std::optional<Packet> PacketQueue::take() {
  if (waiting_.empty()) return std::nullopt;
  Packet packet = std::move(waiting_.front());
  waiting_.pop_front();
  ++taken_;
  if (!packet.subject.empty()) number_.erase(packet.subject);
  return packet;
}

void PacketQueue::clear() {
  displaced_ += waiting_.size();
  taken_ += waiting_.size();
  waiting_.clear();
  number_.clear();
}

}  // namespace ols::exports
