#include "sim/network/relay_queue.h"

namespace ols::sim {

RelayQueue::RelayQueue(const Impairments& impairments, std::uint64_t seed)
    : impairments_(impairments), random_(seed) {}

bool RelayQueue::draw(double probability) {
  return std::uniform_real_distribution<double>()(random_) < probability;
}

void RelayQueue::offer(Packet packet, double time_s) {
  ++counts_.received;
  // All random numbers are always drawn, so that one probability does not change the others'
  // results.
  const bool lost = draw(impairments_.loss), doubled = draw(impairments_.duplicate);
  const bool late = draw(impairments_.reorder), copy_late = draw(impairments_.reorder);
  if (lost) {
    ++counts_.lost;
    return;
  }
  const auto due_s = [this, time_s](bool held) {
    counts_.reordered += held ? 1 : 0;
    return time_s + impairments_.delay_s + (held ? impairments_.reorder_s : 0.0);
  };
  if (doubled) {
    ++counts_.duplicated;
    put(packet, due_s(copy_late));
  }
  put(std::move(packet), due_s(late));
}

void RelayQueue::put(Packet packet, double due_s) {
  if (queue_.size() >= impairments_.capacity) {
    ++counts_.overflowed;
    return;
  }
  queue_.emplace(std::pair(due_s, number_++), std::move(packet));
}

std::vector<Packet> RelayQueue::take(double time_s) {
  std::vector<Packet> due;
  while (!queue_.empty() && queue_.begin()->first.first <= time_s) {
    due.push_back(std::move(queue_.begin()->second));
    queue_.erase(queue_.begin());
    ++counts_.sent;
  }
  return due;
}

}  // namespace ols::sim
