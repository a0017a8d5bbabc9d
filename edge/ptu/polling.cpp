#include "edge/ptu/polling.h"

#include <algorithm>
#include <utility>

namespace ols::ptu {

namespace {

constexpr double kReplySlack_s = 0.08;  // that a unit may need for one cycle
constexpr double kQuiet_s = 0.06;       // silence after a cycle whose replies are missing
constexpr double kShortQuiet_s = 0.02;  // after one whose replies came, but wrong
constexpr double kLatencyShare = 0.05;  // of a new one in the running average

}  // namespace

bool Polling::due(double time_s) const {
  return !cycle_ && time_s >= next_s_ && time_s >= last_byte_s_ + quiet_s_;
}

const std::string& Polling::send(const PtuRequest& commands, const PtuRequest& questions,
                                 double time_s) {
  quiet_s_ = 0.0;
  next_s_ = time_s + interval_s_;
  garbled_ = false;
  return cycle_.emplace(commands, questions, time_s, byte_s_, latency_s_).bytes();
}

bool Polling::silent_for(double duration_s, double time_s) const {
  return time_s - last_byte_s_ > duration_s;
}

std::optional<PollCycle> Polling::take(const PtuReply& reply, double late_s) {
  cycle_->take(reply, late_s);
  if (!cycle_->complete() || cycle_->spoilt()) return std::nullopt;
  latency_s_ += (latency_s_ == 0.0 ? 1.0 : kLatencyShare) * (cycle_->latency_s() - latency_s_);
  return std::exchange(cycle_, std::nullopt);
}

void Polling::unexpected_reply() { quiet_s_ = std::max(quiet_s_, kShortQuiet_s); }

std::optional<Polling::Failure> Polling::watch(double time_s) {
  const bool damaged = garbled_ || cycle_->spoilt();
  const double silent_since_s = std::max(last_byte_s_, cycle_->sent_out_s());
  if (damaged && time_s > silent_since_s + kShortQuiet_s) {
    give_up(time_s, 0.0);
    return Failure::kGarbled;
  }
  if (time_s <= cycle_->due_s(kReplySlack_s)) return std::nullopt;
  give_up(time_s, kQuiet_s);
  return Failure::kRepliesMissing;
}

void Polling::abandon(double time_s) {
  give_up(time_s, kShortQuiet_s);
  last_byte_s_ = std::max(last_byte_s_, time_s);
}

void Polling::give_up(double time_s, double quiet_s) {
  cycle_.reset();
  quiet_s_ = quiet_s;
  next_s_ = std::min(next_s_, time_s);
}

}  // namespace ols::ptu
