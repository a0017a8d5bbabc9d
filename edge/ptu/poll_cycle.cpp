#include "edge/ptu/poll_cycle.h"

#include <algorithm>
#include <cmath>

namespace ols {

namespace {

constexpr double kReplyBytes = 14.0;     // `* -12345`, CR LF and something for a longer number
constexpr double kTimely_s = 1e-3;       // reading a byte may be late by this
constexpr double kLeastTimeSd_s = 1e-4;  // scheduling of this host

}  // namespace

PollCycle::PollCycle(const PtuRequest& commands, double sent_s, double byte_s)
    : sent_s_(sent_s), byte_s_(byte_s) {
  request_.query(PtuAxis::kPan, PtuQuantity::kPosition);
  request_.query(PtuAxis::kTilt, PtuQuantity::kPosition);
  request_.append(commands);
}

double PollCycle::due_s(double slack_s) const {
  const double bytes = static_cast<double>(request_.bytes().size()) +
                       kReplyBytes * static_cast<double>(request_.commands());
  return sent_s_ + bytes * byte_s_ + slack_s;
}

PollCycle::Outcome PollCycle::take(const PtuReply& reply) {
  if (complete()) return Outcome::kWrong;
  const std::size_t index = taken_++;
  if (index < 2) {
    const bool good = read(reply, index, index == 0 ? pan_ : tilt_);
    return good ? Outcome::kTaken : Outcome::kWrong;
  }
  // A set command is answered without a value; a value means that replies are out of step.
  if (reply.ok) return reply.text.empty() ? Outcome::kTaken : Outcome::kWrong;
  return Outcome::kRefused;
}

// The unit cannot have read its counter before the command's last byte was on the line, nor after
// the reply began.
bool PollCycle::read(const PtuReply& reply, std::size_t index, Reading& reading) const {
  const auto counts = reply.count();
  if (!reply.ok || !counts) return false;
  reading.counts = *counts;
  reading.reply_bytes = reply.text.size() + 4;  // with `* `, CR and LF
  reading.earliest_s = sent_s_ + static_cast<double>(request_.end_of(index)) * byte_s_;
  reading.latest_s = std::max(reading.earliest_s, reply.began_s - byte_s_);
  return true;
}

AngleSample PollCycle::sample(const PtuFacts& facts, double tilt_rate_rad_s,
                              double usual_latency_s) const {
  const double uniform = 1.0 / std::sqrt(12.0);
  double tilt_s = 0.5 * (tilt_.earliest_s + tilt_.latest_s);
  double tilt_sd_s = uniform * (tilt_.latest_s - tilt_.earliest_s);
  // A reply that had to wait for the end of the pan's says nothing of when the unit read its
  // counter. Then it began when it had both the query and the pan's reply behind it, and took as
  // long as usual: a moment drawn from a latency that is distributed exponentially is half its mean
  // away and has this standard deviation.
  const double end_of_pan_s = pan_.latest_s + static_cast<double>(pan_.reply_bytes) * byte_s_;
  if (tilt_.latest_s < end_of_pan_s + 1.5 * byte_s_ + kTimely_s) {
    const double begin_s = std::max(tilt_.earliest_s, pan_.latest_s);
    tilt_s = std::min(tilt_.latest_s, begin_s + 0.5 * usual_latency_s);
    tilt_sd_s = std::min(tilt_sd_s, std::sqrt(2.0 / 3.0 - 1.0 / 4.0) * usual_latency_s);
  }
  AngleSample sample;
  sample.time_s = read_s();
  sample.time_sd_s = std::max(kLeastTimeSd_s, uniform * latency_s());
  sample.tilt_time_sd_s = std::max(kLeastTimeSd_s, tilt_sd_s);
  sample.angles.pan_rad = pan_.counts * facts.pan.resolution_rad;
  sample.angles.tilt_rad =
      tilt_.counts * facts.tilt.resolution_rad - tilt_rate_rad_s * (tilt_s - read_s());
  return sample;
}

}  // namespace ols
