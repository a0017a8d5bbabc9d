// Exchanges requests and replies with a ready unit, one poll cycle at a time. The next cycle is
// sent when it is due and the line is quiet. Pure.
#pragma once

#include <optional>
#include <string>

#include "edge/ptu/poll_cycle.h"

namespace ols::ptu {

class Polling {
 public:
  Polling(double interval_s, double byte_s, double time_s)
      : interval_s_(interval_s), byte_s_(byte_s), next_s_(time_s), last_byte_s_(time_s) {}

  bool under_way() const { return cycle_.has_value(); }
  bool due(double time_s) const;
  // Begins a cycle. Returns the bytes to write.
  const std::string& send(const PtuRequest& commands, const PtuRequest& questions, double time_s);

  void bytes_came(double time_s) { last_byte_s_ = time_s; }
  void line_was_garbled() { garbled_ = true; }
  // Whether no bytes have come for `duration_s`.
  bool silent_for(double duration_s, double time_s) const;

  // Takes a reply of the current cycle. Returns the cycle when it is complete and usable.
  std::optional<PollCycle> take(const PtuReply& reply, double late_s);
  // Notes a reply that came between two cycles. The next cycle then waits until the line is quiet.
  void unexpected_reply();

  enum class Failure { kGarbled, kRepliesMissing };
  // Abandons the current cycle if it can no longer be completed, and returns the reason.
  std::optional<Failure> watch(double time_s);
  // Abandons the current cycle, because other bytes were written.
  void abandon(double time_s);

 private:
  void give_up(double time_s, double quiet_s);

  const double interval_s_, byte_s_;
  std::optional<PollCycle> cycle_;
  bool garbled_ = false;    // a line was garbled in the current cycle
  double latency_s_ = 0.0;  // running average of PollCycle::latency_s()
  double next_s_;
  double quiet_s_ = 0.0;  // silence that is required before the next cycle
  double last_byte_s_;
};

}  // namespace ols::ptu
