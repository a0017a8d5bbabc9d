#include "edge/ptu/poll_cycle.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace ols {

namespace {

constexpr double kReplyBytes = 14.0;  // `* -12345`, CR LF and something for a longer number

bool is_terse(const PtuReply& reply) {
  return reply.text.empty() || std::isalpha(static_cast<unsigned char>(reply.text[0])) == 0;
}

}  // namespace

PollCycle::PollCycle(const PtuRequest& commands, const PtuRequest& questions, double sent_s,
                     double byte_s, double usual_latency_s)
    : sent_s_(sent_s), byte_s_(byte_s), usual_latency_s_(usual_latency_s) {
  const std::size_t n = commands.commands();
  request_.delimiter();
  ask(PtuAxis::kPan);
  give(commands, 0, (n + 2) / 3);
  ask(PtuAxis::kTilt);
  give(commands, (n + 2) / 3, (2 * n + 2) / 3);
  ask(PtuAxis::kTilt);
  give(commands, (2 * n + 2) / 3, n);
  ask(PtuAxis::kPan);
  request_.append(questions);
  slots_.insert(slots_.end(), questions.commands(), Slot::kQuestion);
}

void PollCycle::ask(PtuAxis axis) {
  request_.query(axis, PtuQuantity::kPosition);
  slots_.push_back(axis == PtuAxis::kPan ? Slot::kPan : Slot::kTilt);
}

void PollCycle::give(const PtuRequest& commands, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    std::string_view command = commands.command(i);
    command.remove_suffix(1);  // plain() adds the delimiter
    request_.plain(command);
    slots_.push_back(Slot::kCommand);
  }
}

double PollCycle::sent_out_s() const {
  return sent_s_ + static_cast<double>(request_.bytes().size()) * byte_s_;
}

double PollCycle::due_s(double slack_s) const {
  return sent_out_s() + kReplyBytes * static_cast<double>(request_.commands()) * byte_s_ + slack_s;
}

bool PollCycle::stands_for_position(const PtuReply& reply) const {
  return reply.ok && reply.count().has_value();
}

void PollCycle::take(const PtuReply& reply, double late_s) {
  modes_forgotten_ = modes_forgotten_ || reply.echoed;
  if (complete()) {
    spoilt_ = true;
    return;
  }
  late_s_ = late_s;
  // A value where `*` should be: the replies between them were lost.
  while (!complete() && slots_[taken_] == Slot::kCommand && stands_for_position(reply)) {
    command_lost_ = true;
    ++taken_;
  }
  if (complete()) {
    spoilt_ = true;
    return;
  }
  const Slot slot = slots_[taken_++];
  if (slot == Slot::kQuestion) {
    answers_.push_back(reply);
  } else if (slot != Slot::kCommand) {
    take_position(reply, slot);
  } else if (!reply.ok) {
    refusals_.push_back(reply.text);
  } else {
    command_lost_ = command_lost_ || !reply.text.empty();
  }
  follow_unit(reply);
}

// How far the unit has come with this reply: for certain where its begin shows it, and about.
void PollCycle::follow_unit(const PtuReply& reply) {
  const double began_s = reply.began_s - byte_s_;
  if (!waited(reply)) {
    unit_busy_s_ = began_s - late_s_;
    unit_free_s_ = began_s - 0.5 * late_s_;
  } else {
    unit_free_s_ = std::min(began_s, begun_s() + usual_latency_s_);
  }
  line_busy_s_ = reply.ended_s;
}

double PollCycle::asked_s() const {
  return sent_s_ + static_cast<double>(request_.end_of(taken_ - 1)) * byte_s_;
}

double PollCycle::begun_s() const { return std::max(asked_s(), unit_free_s_); }

// Whether the reply may have had to wait for the one before it to be out.
bool PollCycle::waited(const PtuReply& reply) const {
  return line_busy_s_ && reply.began_s - byte_s_ < *line_busy_s_ + 1.5 * byte_s_ + late_s_;
}

void PollCycle::take_position(const PtuReply& reply, Slot slot) {
  if (!stands_for_position(reply)) {
    spoilt_ = true;
    return;
  }
  modes_forgotten_ = modes_forgotten_ || !is_terse(reply);
  if (taken_ == 1) latency_s_ = std::max(0.0, reply.began_s - byte_s_ - asked_s());
  (slot == Slot::kPan ? pan_[pans_++] : tilt_[tilts_++]) = read_at(reply);
}

// The unit cannot have read its counter before the query's last byte was on the line, nor before it
// was done with the command before, nor after the reply began: any moment between them is as good.
// But a reply that had to wait for the end of another says nothing of when the counter was read:
// then the usual latency decides, half of it on the average.
PtuReading PollCycle::read_at(const PtuReply& reply) const {
  const double latest_s = std::max(asked_s(), reply.began_s - byte_s_);
  const double earliest_s = std::clamp(unit_busy_s_, asked_s(), latest_s);
  const double middle_s = 0.5 * (earliest_s + latest_s);
  PtuReading reading;
  reading.counts = *reply.count();
  reading.time_s = middle_s;
  if (waited(reply)) {
    reading.time_s = std::clamp(begun_s() + 0.5 * usual_latency_s_, earliest_s, latest_s);
  }
  reading.half_s = 0.5 * (latest_s - earliest_s) + std::abs(reading.time_s - middle_s);
  // Uniform for the first query, for those behind it less wide: the unit had something else to do.
  reading.time_sd_s = reading.half_s / (taken_ == 1 ? std::sqrt(3.0) : 2.0);
  return reading;
}

}  // namespace ols
