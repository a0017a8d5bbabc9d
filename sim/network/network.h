// The network between stations and fusion in simulated time: it delays, loses and duplicates
// messages. Deterministic. Messages that arrive at the same instant keep the order in which they
// were sent.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "sim/scenario/scenario.h"

namespace ols::sim {

template <class Message>
class Network {
 public:
  Network(const Errors::Messages& errors, std::uint64_t seed) : errors_(errors), generator_(seed) {}

  void send(const Message& message, double time_s) {
    // Always draws all random numbers: switching one error on or off does not change the others.
    const bool lost = draw() < errors_.lost, doubled = draw() < errors_.doubled;
    const bool late = draw() < errors_.late;
    if (errors_.on && lost) return;
    const double arrival_s = time_s + errors_.delay_s + (errors_.on && late ? errors_.late_s : 0.0);
    put(message, arrival_s);
    if (errors_.on && doubled) put(message, arrival_s + errors_.delay_s);
  }

  // The messages that have arrived by now, in order of arrival.
  std::vector<Message> receive(double time_s) {
    std::vector<Message> arrived;
    while (!queue_.empty() && queue_.begin()->first.first <= time_s) {
      arrived.push_back(std::move(queue_.begin()->second));
      queue_.erase(queue_.begin());
    }
    return arrived;
  }

 private:
  double draw() { return std::uniform_real_distribution<double>()(generator_); }
  void put(const Message& message, double arrival_s) {
    queue_.emplace(std::pair(arrival_s, sent_++), message);
  }

  Errors::Messages errors_;
  std::mt19937_64 generator_;
  std::uint64_t sent_ = 0;
  std::map<std::pair<double, std::uint64_t>, Message> queue_;
};

}  // namespace ols::sim
