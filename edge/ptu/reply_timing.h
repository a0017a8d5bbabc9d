// Estimates the time at which a unit read the counter that it reports. Replies have no time stamp.
// Only two times are known: the end of the query, and the beginning of the reply. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/ptu/codec.h"

namespace ols::ptu {

struct PtuReading {
  std::int32_t counts = 0;
  double time_s = 0.0;     // estimated time at which the unit read its counter
  double time_sd_s = 0.0;  // 1-sigma of time_s
  double half_s = 0.0;     // largest error of time_s
};

// Processes the replies of one poll cycle, in order. `asked_s`: time at which the command that the
// reply answers had been sent. `late_s`: the longest time for which the reply's bytes may have
// waited before they were read.
class ReplyTiming {
 public:
  // `usual_latency_s`: the usual time from the end of a query to the start of its reply.
  ReplyTiming(double byte_s, double usual_latency_s)
      : byte_s_(byte_s), usual_latency_s_(usual_latency_s) {}

  // The reading in a reply with a position. `first`: the reply is the first one of the cycle, so
  // that the unit was idle before.
  PtuReading read_at(const PtuReply& reply, double asked_s, double late_s, bool first) const;
  double latency_s(const PtuReply& reply, double asked_s) const;

  // Call for each reply, after read_at().
  void follow(const PtuReply& reply, double asked_s, double late_s);

 private:
  double started_s(const PtuReply& reply) const { return reply.began_s - byte_s_; }
  // Estimated time at which the unit began to execute the command.
  double begun_s(double asked_s) const;
  bool waited(const PtuReply& reply, double late_s) const;

  double byte_s_;
  double usual_latency_s_;
  std::optional<double> line_busy_s_;  // time at which the last reply ended
  double unit_busy_s_ = 0.0;  // the unit executed the previous command at least until this time
  double unit_free_s_ = 0.0;  // estimated time at which the unit finished the previous command
};

}  // namespace ols::ptu
