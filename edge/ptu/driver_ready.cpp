// Bytes and time to whom they concern, and a unit that can be driven.
#include <algorithm>
#include <utility>

#include "edge/ptu/driver_impl.h"

namespace ols {

std::string PtuDriver::Impl::step_ready(double time_s) {
  if (reference.doubt() != PtuDoubt::kNone) {
    goal.reset();
    if (may_home()) {
      want_home(time_s);
      return std::exchange(urgent, {});
    }
  }
  std::string bytes = steady->step(goal, emergency, time_s);
  heed_trouble(time_s);
  return bytes;
}

// Before the replies are taken that came with them.
void PtuDriver::Impl::note_limit_hits(const std::vector<PtuReply>& replies, double time_s) {
  const PtuLimitHits hits = parser.limit_hits() - hits_noted;
  hits_noted = parser.limit_hits();
  if (phase != Phase::kReady) {
    reference.while_not_driven(hits, line_rate(), time_s);
    return;
  }
  const bool homing_hits = std::any_of(replies.begin(), replies.end(), [](const PtuReply& r) {
    return r.limit_hits >= PtuSteadyState::kHomingHits;
  });
  reference.while_driven(hits, homing_hits);
}

void PtuDriver::Impl::heed_trouble(double time_s) {
  if (!steady || !steady->trouble()) return;
  using Kind = PtuSteadyState::Trouble::Kind;
  const PtuSteadyState::Trouble trouble = *steady->trouble();
  fault(time_s, trouble.reason);
  link_lost = link_lost || trouble.kind == Kind::kNoReply;
  if (trouble.kind == Kind::kBeganAnew) {
    note_power_cycle();
    reference.begins(baud, time_s);
  }
  unreferenced = trouble.kind == Kind::kNotReferenced;
  if (unreferenced) home_if(may_home(), time_s);
}

std::string PtuDriver::Impl::step(double time_s) {
  if (!urgent.empty()) return std::exchange(urgent, {});
  switch (phase) {
    case Phase::kPause:
      return step_pause(time_s);
    case Phase::kFlush:
      return step_flush(time_s);
    case Phase::kStart:
      return step_start(time_s);
    case Phase::kHoming:
      return step_homing(time_s);
    case Phase::kReady:
      return step_ready(time_s);
  }
  return {};
}

void PtuDriver::Impl::note_call(double time_s) {
  const double unread_s = std::max(0.0, time_s - called_s);
  late_s = std::max(unread_s, std::exchange(last_unread_s, unread_s));
  called_s = time_s;
}

void PtuDriver::Impl::take(const PtuReply& reply, double time_s) {
  ++counters.replies;
  if (phase == Phase::kStart) {
    take_start_reply(reply, time_s);
  } else if (phase == Phase::kHoming) {
    take_homing_reply(reply, time_s);
  } else if (phase == Phase::kReady) {
    steady->take(reply, time_s, late_s);
  }
}

}  // namespace ols
