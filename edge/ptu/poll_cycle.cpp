#include "edge/ptu/poll_cycle.h"

#include <cctype>

namespace ols::ptu {

namespace {

constexpr double kReplyBytes = 14.0;  // `* -12345`, CR LF and something for a longer number

bool is_terse(const PtuReply& reply) {
  return reply.text.empty() || std::isalpha(static_cast<unsigned char>(reply.text[0])) == 0;
}

bool holds_position(const PtuReply& reply) { return reply.ok && reply.count().has_value(); }

}  // namespace

PollCycle::PollCycle(const PtuRequest& commands, const PtuRequest& questions, double sent_s,
                     double byte_s, double usual_latency_s)
    : sent_s_(sent_s), byte_s_(byte_s), timing_(byte_s, usual_latency_s) {
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

void PollCycle::take(const PtuReply& reply, double late_s) {
  modes_forgotten_ = modes_forgotten_ || reply.echoed;
  // A value in place of `*`: the replies between them were lost.
  while (!complete() && slots_[taken_] == Slot::kCommand && holds_position(reply)) {
    command_lost_ = true;
    ++taken_;
  }
  if (complete()) {
    spoilt_ = true;
    return;
  }
  const double asked_s = sent_s_ + static_cast<double>(request_.end_of(taken_)) * byte_s_;
  switch (slots_[taken_++]) {
    case Slot::kPan:
      take_position(reply, pan_, asked_s, late_s);
      break;
    case Slot::kTilt:
      take_position(reply, tilt_, asked_s, late_s);
      break;
    case Slot::kCommand:
      if (!reply.ok) refusals_.push_back(reply.text);
      command_lost_ = command_lost_ || (reply.ok && !reply.text.empty());
      break;
    case Slot::kQuestion:
      answers_.push_back(reply);
      break;
  }
  timing_.follow(reply, asked_s, late_s);
}

void PollCycle::take_position(const PtuReply& reply, Axis& axis, double asked_s, double late_s) {
  if (!holds_position(reply)) {
    spoilt_ = true;
    return;
  }
  modes_forgotten_ = modes_forgotten_ || !is_terse(reply);
  const bool first = taken_ == 1;
  if (first) latency_s_ = timing_.latency_s(reply, asked_s);
  axis.readings[axis.taken++] = timing_.read_at(reply, asked_s, late_s, first);
}

}  // namespace ols::ptu
