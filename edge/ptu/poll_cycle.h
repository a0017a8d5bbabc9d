// One steady-state exchange with the unit: what was asked, which replies are still to come, and
// what the positions in them mean in time. Pure.
#pragma once

#include <optional>

#include "edge/ptu/angle_history.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/start_sequence.h"

namespace ols {

class PollCycle {
 public:
  // `commands`: what goes behind the two position queries. Not in front: the unit would work on
  // them first, and the instant of the positions would be known less well.
  PollCycle(const PtuRequest& commands, double sent_s, double byte_s);

  const std::string& bytes() const { return request_.bytes(); }
  // All replies are there by then, if the unit takes no longer than `slack_s` over them.
  double due_s(double slack_s) const;

  enum class Outcome { kTaken, kRefused, kWrong };
  // The next reply. kRefused: the unit refuses a command; kWrong: not an answer to what was asked.
  Outcome take(const PtuReply& reply);
  bool complete() const { return taken_ == request_.commands(); }

  std::int32_t pan_counts() const { return pan_.counts; }
  std::int32_t tilt_counts() const { return tilt_.counts; }

  // About when the unit read its pan position.
  double read_s() const { return 0.5 * (pan_.earliest_s + pan_.latest_s); }
  // Between the pan query's last byte and the begin of its reply: what the unit (and this host's
  // reading) took over it.
  double latency_s() const { return pan_.latest_s - pan_.earliest_s; }

  // The angles at the instant at which the unit read its pan position. `tilt_rate_rad_s` moves the
  // tilt, read a little later, there; `usual_latency_s` is an average of latency_s().
  AngleSample sample(const PtuFacts& facts, double tilt_rate_rad_s, double usual_latency_s) const;

 private:
  struct Reading {
    std::int32_t counts = 0;
    double earliest_s = 0.0, latest_s = 0.0;  // the unit read its counter between them
    std::size_t reply_bytes = 0;
  };
  bool read(const PtuReply& reply, std::size_t index, Reading& reading) const;

  PtuRequest request_;
  double sent_s_;
  double byte_s_;
  std::size_t taken_ = 0;
  Reading pan_, tilt_;
};

}  // namespace ols
