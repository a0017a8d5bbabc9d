// Estimates when the unit read the counter that it reports. Replies carry no time stamp. Only two
// instants are known: when the query was on the line, and when the reply began. Pure.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/ptu/codec.h"

namespace ols::ptu {

struct PtuReading {
  std::int32_t counts = 0;
  double time_s = 0.0;     // when the unit read its counter: estimate,
  double time_sd_s = 0.0;  // its standard deviation,
  double half_s = 0.0;     // and its maximum error
};

// Follows the replies of one cycle, in order. `asked_s`: when the command of a reply was on the
// line. `late_s`: the reply's bytes may have waited up to this long before they were read.
class ReplyTiming {
 public:
  // `usual_latency_s`: of the unit, from the end of a query to the start of its reply.
  ReplyTiming(double byte_s, double usual_latency_s)
      : byte_s_(byte_s), usual_latency_s_(usual_latency_s) {}

  // A position. `first`: it is the first position of the cycle, so the unit was idle before.
  PtuReading read_at(const PtuReply& reply, double asked_s, double late_s, bool first) const;
  double latency_s(const PtuReply& reply, double asked_s) const;

  // Call for each reply, after read_at().
  void follow(const PtuReply& reply, double asked_s, double late_s);

 private:
  double started_s(const PtuReply& reply) const { return reply.began_s - byte_s_; }
  double begun_s(double asked_s) const;  // estimate of when the unit began the command
  bool waited(const PtuReply& reply, double late_s) const;

  double byte_s_;
  double usual_latency_s_;
  std::optional<double> line_busy_s_;  // until the end of the last reply
  double unit_busy_s_ = 0.0;           // with the last command, at least until then
  double unit_free_s_ = 0.0;           // from about then
};

}  // namespace ols::ptu
