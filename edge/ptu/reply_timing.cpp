#include "edge/ptu/reply_timing.h"

#include <algorithm>
#include <cmath>

namespace ols::ptu {

// The unit read its counter after the query's last byte was on the line, after it had finished the
// command before, and before the reply began; any instant between is equally likely. But the start
// of a reply that had to wait for the end of another does not bound the instant: there the usual
// latency gives the estimate, half of it on average.
PtuReading ReplyTiming::read_at(const PtuReply& reply, double asked_s, double late_s,
                                bool first) const {
  const double latest_s = std::max(asked_s, started_s(reply));
  const double earliest_s = std::clamp(unit_busy_s_, asked_s, latest_s);
  const double middle_s = 0.5 * (earliest_s + latest_s);
  PtuReading reading;
  reading.counts = *reply.count();
  reading.time_s = middle_s;
  if (waited(reply, late_s)) {
    reading.time_s = std::clamp(begun_s(asked_s) + 0.5 * usual_latency_s_, earliest_s, latest_s);
  }
  reading.half_s = 0.5 * (latest_s - earliest_s) + std::abs(reading.time_s - middle_s);
  // Uniform for the first query; narrower for the others, before which the unit was busy.
  reading.time_sd_s = reading.half_s / (first ? std::sqrt(3.0) : 2.0);
  return reading;
}

double ReplyTiming::latency_s(const PtuReply& reply, double asked_s) const {
  return std::max(0.0, started_s(reply) - asked_s);
}

void ReplyTiming::follow(const PtuReply& reply, double asked_s, double late_s) {
  if (!waited(reply, late_s)) {
    unit_busy_s_ = started_s(reply) - late_s;
    unit_free_s_ = started_s(reply) - 0.5 * late_s;
  } else {
    unit_free_s_ = std::min(started_s(reply), begun_s(asked_s) + usual_latency_s_);
  }
  line_busy_s_ = reply.ended_s;
}

double ReplyTiming::begun_s(double asked_s) const { return std::max(asked_s, unit_free_s_); }

// Whether the reply may have had to wait until the one before it was on the line.
bool ReplyTiming::waited(const PtuReply& reply, double late_s) const {
  return line_busy_s_ && started_s(reply) < *line_busy_s_ + 1.5 * byte_s_ + late_s;
}

}  // namespace ols::ptu
