#include "edge/ptu/steady_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ols {

namespace {

constexpr double kReplySlack_s = 0.08;      // what a unit may take over one cycle
constexpr double kQuiet_s = 0.06;           // silence after a cycle whose replies are missing
constexpr double kShortQuiet_s = 0.02;      // after one whose replies came, but wrong
constexpr double kLatencyShare = 0.05;      // of a new one in the running average
constexpr int kChecksAtMost = 5;            // of the modes, before the unit is started again
constexpr int kBoundsRefused = 3;           // refusals for travel or speed within
constexpr double kBoundsRefused_s = 5.0;    // this time: what was read at the start is not so
constexpr std::size_t kSamplesKept = 1000;  // when nobody takes them

AngleHistory::Config history_config(const PtuConfig& config, const PtuFacts& facts) {
  AngleHistory::Config history = config.history;
  history.step_rad = facts.pan.resolution_rad;
  return history;
}

}  // namespace

PtuSteadyState::PtuSteadyState(const PtuConfig& config, const PtuFacts& facts, double byte_s,
                               double time_s, PtuCounters& counters)
    : config_(config),
      facts_(facts),
      byte_s_(byte_s),
      counters_(counters),
      commands_(config, facts),
      check_(facts),
      history_(history_config(config, facts)),
      next_poll_s_(time_s),
      last_byte_s_(time_s),
      next_environment_s_(time_s) {}

std::string PtuSteadyState::step(bool emergency, double time_s) {
  if (trouble_) return {};
  if (waiting_since_s_ && time_s - *waiting_since_s_ > config_.reply_timeout_s) {
    const bool silent = time_s - last_byte_s_ > config_.reply_timeout_s;
    if (silent && cycle_) ++counters_.timeouts;
    fail(silent ? Trouble::Kind::kNoReply : Trouble::Kind::kNotItself,
         silent ? "no reply" : "no position to be believed: " + error_);
    return {};
  }
  if (cycle_) return watch(time_s);
  if (time_s < next_poll_s_ || time_s < last_byte_s_ + quiet_s_) return {};
  quiet_s_ = 0.0;
  next_poll_s_ = time_s + config_.poll_interval_s;
  line_garbled_ = false;
  checking_modes_ = check_modes_;
  const PtuRequest commands = commands_for(emergency, time_s);
  const PanTilt& change = commands_.speed_change_rad_s();
  told_ = {std::max(told_.pan_rad, change.pan_rad), std::max(told_.tilt_rad, change.tilt_rad)};
  cycle_.emplace(commands, questions_for(time_s), time_s, byte_s_, latency_s_);
  ++counters_.requests;
  if (!waiting_since_s_) waiting_since_s_ = time_s;
  return cycle_->bytes();
}

PtuRequest PtuSteadyState::commands_for(bool emergency, double time_s) {
  const auto interpolated = history_.at(time_s);
  const auto newest = history_.newest();
  MotionCommands::Now now;
  now.rate_rad_s = check_.rate_rad_s();
  now.standing = check_.standing();
  if (emergency)
    return now.standing ? commands_.halt(now, time_s) : commands_.halt_anew(now, time_s);
  // As long as it may take speeds for velocities it is told nothing.
  if (check_modes_) return PtuRequest().plain("ED").plain("FT");
  if (!newest) return {};
  // Replies that are read too late to tell when keep the link up, but nobody drives by them.
  if (time_s - newest->time_s > config_.reply_timeout_s) return commands_.halt(now, time_s);
  now.angles = interpolated ? interpolated->angles : newest->angles;
  return commands_.next(goal_, now, time_s);
}

PtuRequest PtuSteadyState::questions_for(double time_s) {
  PtuRequest questions;
  if (check_modes_) {
    questions.plain("C").query(PtuAxis::kPan, PtuQuantity::kAcceleration);
    return questions;
  }
  ask_environment_ = config_.environment_interval_s > 0.0 && time_s >= next_environment_s_;
  if (ask_environment_) {
    next_environment_s_ = time_s + config_.environment_interval_s;
    questions.plain("O");
  }
  return questions;
}

// A cycle that is under way: is it still to come to an end?
std::string PtuSteadyState::watch(double time_s) {
  const bool damaged = line_garbled_ || cycle_->spoilt();
  const double silent_since_s = std::max(last_byte_s_, cycle_->sent_out_s());
  if (damaged && time_s > silent_since_s + kShortQuiet_s) {
    ++counters_.garbled;
    give_up_cycle(time_s, 0.0, "a reply was garbled");
  } else if (time_s > cycle_->due_s(kReplySlack_s)) {
    ++counters_.timeouts;
    give_up_cycle(time_s, kQuiet_s, "replies are missing");
  }
  return {};
}

void PtuSteadyState::give_up_cycle(double time_s, double quiet_s, std::string reason) {
  error_ = std::move(reason);
  cycle_.reset();
  commands_.send_all_again();
  quiet_s_ = quiet_s;
  next_poll_s_ = std::min(next_poll_s_, time_s);
}

void PtuSteadyState::abandon(double time_s) {
  give_up_cycle(time_s, kShortQuiet_s, "interrupted");
  last_byte_s_ = std::max(last_byte_s_, time_s);
}

void PtuSteadyState::fail(Trouble::Kind kind, std::string reason) {
  if (!trouble_) trouble_ = Trouble{kind, std::move(reason)};
}

void PtuSteadyState::unit_began_anew() {
  fail(Trouble::Kind::kBeganAnew, "the unit was switched off and on, or homed");
}

void PtuSteadyState::take(const PtuReply& reply, double time_s, double late_s) {
  if (reply.limit_hits >= kHomingHits) {
    unit_began_anew();
    return;
  }
  if (!cycle_) {
    ++counters_.garbled;
    error_ = "a reply to nothing";
    quiet_s_ = std::max(quiet_s_, kShortQuiet_s);
    return;
  }
  cycle_->take(reply, late_s);
  if (cycle_->complete() && !cycle_->spoilt()) finish(time_s);
}

void PtuSteadyState::finish(double time_s) {
  const PollCycle done = std::move(*cycle_);
  cycle_.reset();
  latency_s_ += (latency_s_ == 0.0 ? 1.0 : kLatencyShare) * (done.latency_s() - latency_s_);
  if (done.command_lost()) {
    ++counters_.garbled;
    error_ = "a reply to a command is missing";
    commands_.send_all_again();
  }
  judge_refusals(done.refusals(), time_s);
  judge_modes(done);
  if (ask_environment_ && !checking_modes_ && !done.answers().empty()) {
    if (const auto said = ptu_environment(done.answers().front().text)) environment_ = said;
  }
  // Echoes stand in the way of replies: nobody knows when these positions were read.
  if (done.modes_forgotten()) return;
  switch (check_.take(done.pan(), done.tilt(), told_rad_s2(time_s))) {
    case PositionCheck::Verdict::kFirst:
    case PositionCheck::Verdict::kLate:
      waiting_since_s_.reset();
      break;
    case PositionCheck::Verdict::kBelieved:
      believe(check_.sample(), time_s);
      break;
    case PositionCheck::Verdict::kRefused:
      ++counters_.refused_positions;
      error_ = "positions that contradict each other";
      commands_.send_all_again();
      break;
  }
}

// Echo or verbose replies in mid-run: switched off again, without a new start. But the unit may
// have been switched off and on, and then takes speeds for velocities or has other ramps.
void PtuSteadyState::judge_modes(const PollCycle& done) {
  if (checking_modes_ && !done.modes_forgotten()) {
    const auto& answers = done.answers();
    const bool itself = answers.size() == 2 && says_independent(answers[0]) && answers[1].ok &&
                        answers[1].count() == facts_.pan.acceleration;
    if (itself) {
      check_modes_ = false;
      checks_failed_ = 0;
      commands_.send_all_again();
      return;
    }
  }
  if (checking_modes_ && ++checks_failed_ >= kChecksAtMost) {
    fail(Trouble::Kind::kBeganAnew, "the unit has forgotten its modes");
  }
  if (!done.modes_forgotten()) return;
  if (!check_modes_) ++counters_.echoes;
  check_modes_ = true;
}

// About as much as the unit was told to accelerate by since the last sample. When a cycle was lost
// between them the speed may have changed all at once in the middle.
PanTilt PtuSteadyState::told_rad_s2(double time_s) const {
  constexpr double kShare = 0.8;  // it may begin or end anywhere between the samples
  const double gap_s = std::max(1e-3, time_s - last_sample_s_.value_or(time_s));
  const double at_once = gap_s > 1.8 * config_.poll_interval_s ? 2.0 : 1.0;
  const auto told = [=, this](double change_rad_s) {
    return kShare *
           std::min(config_.history.acceleration_max_rad_s2, at_once * change_rad_s / gap_s);
  };
  return {told(told_.pan_rad), told(told_.tilt_rad)};
}

void PtuSteadyState::believe(const AngleSample& sample, double time_s) {
  waiting_since_s_.reset();
  told_ = commands_.speed_change_rad_s();  // may still be going on
  if (!history_.add(sample)) return;
  last_sample_s_ = time_s;
  if (samples_.size() >= kSamplesKept) samples_.erase(samples_.begin());
  samples_.push_back(sample);
}

void PtuSteadyState::judge_refusals(const std::vector<std::string>& refusals, double time_s) {
  for (const std::string& text : refusals) {
    ++counters_.errors;
    error_ = text;
    commands_.send_all_again();
    const PtuComplaint what = complaint(text);
    if (what == PtuComplaint::kNotReferenced) fail(Trouble::Kind::kNotReferenced, text);
    const bool bounds = what == PtuComplaint::kPositionLimit || what == PtuComplaint::kSpeedLimit;
    if (!bounds) continue;
    // One may be a command that was changed on its way.
    if (time_s - bounds_refused_s_ > kBoundsRefused_s) bounds_refused_ = 0;
    bounds_refused_s_ = time_s;
    if (++bounds_refused_ >= kBoundsRefused) {
      fail(Trouble::Kind::kNotItself, "the unit's bounds have changed: " + text);
    }
  }
}

}  // namespace ols
