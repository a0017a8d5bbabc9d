#include "edge/ptu/steady_state.h"

#include <utility>

namespace ols::ptu {

namespace {

constexpr int kBoundsRefused = 3;         // refusals for travel or speed within
constexpr double kBoundsRefused_s = 5.0;  // this time: the unit's bounds have changed
constexpr const char* kDisturbedLine = "replies are late, missing or garbled";

}  // namespace

PtuSteadyState::PtuSteadyState(const PtuConfig& config, const PtuFacts& facts, double byte_s,
                               double time_s, PtuCounters& counters)
    : config_(config),
      facts_(facts),
      counters_(counters),
      commands_(config, facts),
      polling_(config.poll_interval_s, byte_s, time_s),
      angles_(config, facts),
      modes_(facts.pan.acceleration),
      environment_{time_s} {}

std::string PtuSteadyState::step(bool emergency, double time_s) {
  if (trouble_) return {};
  if (waiting_since_s_ && time_s - *waiting_since_s_ > config_.reply_timeout_s) {
    give_up_waiting(time_s);
    return {};
  }
  if (polling_.under_way()) {
    watch(time_s);
    return {};
  }
  if (!polling_.due(time_s)) return {};
  modes_.begin_cycle();
  const PtuRequest commands = commands_for(emergency, time_s);
  angles_.commanded(commands_.speed_change_rad_s());
  ++counters_.requests;
  if (!waiting_since_s_) waiting_since_s_ = time_s;
  return polling_.send(commands, questions_for(time_s), time_s);
}

PtuRequest PtuSteadyState::commands_for(bool emergency, double time_s) {
  MotionCommands::Now now;
  now.rate_rad_s = angles_.rate_rad_s();
  now.standing = angles_.standing();
  if (emergency) {
    return now.standing ? commands_.halt(now, time_s) : commands_.halt_again(now, time_s);
  }
  if (modes_.needed()) return ModeCheck::commands();
  const auto newest_s = angles_.newest_s();
  if (!newest_s) return {};
  // Replies that are read too late to date them keep the link up, but the servo needs newer angles.
  if (time_s - *newest_s > config_.reply_timeout_s) return commands_.halt(now, time_s);
  now.angles = *angles_.angles_at(time_s);
  return commands_.next(goal_, now, time_s);
}

PtuRequest PtuSteadyState::questions_for(double time_s) {
  environment_.asked =
      !modes_.needed() && config_.environment_interval_s > 0.0 && time_s >= environment_.next_s;
  if (modes_.needed()) return ModeCheck::questions();
  if (!environment_.asked) return {};
  environment_.next_s = time_s + config_.environment_interval_s;
  return PtuRequest().plain("O");
}

void PtuSteadyState::give_up_waiting(double time_s) {
  const bool silent = polling_.silent_for(config_.reply_timeout_s, time_s);
  if (silent && polling_.under_way()) ++counters_.timeouts;
  fail(silent ? Trouble::Kind::kNoReply : Trouble::Kind::kNotItself,
       silent ? "no reply" : "no plausible position: " + error_);
}

void PtuSteadyState::watch(double time_s) {
  const auto failure = polling_.watch(time_s);
  if (!failure) return;
  const bool garbled = *failure == Polling::Failure::kGarbled;
  ++(garbled ? counters_.garbled : counters_.timeouts);
  send_all_again(kDisturbedLine, time_s);
}

void PtuSteadyState::abandon(double time_s) {
  polling_.abandon(time_s);
  send_all_again("interrupted", time_s);
}

// Some of the commands may not have reached the unit.
void PtuSteadyState::send_all_again(std::string because, double time_s) {
  note_corrected(std::move(because), time_s);
  commands_.send_all_again();
}

// What comes within a second is one disturbance: of a reply that is late, each line is unexpected.
void PtuSteadyState::note_corrected(std::string what, double time_s) {
  if (time_s - corrected_.since_s > kCorrected_s) corrected_ = {.since_s = time_s};
  if (time_s - corrected_.last_s > kDisturbed_s) {
    ++corrected_.times;
    corrected_.last_s = time_s;
  }
  error_ = std::move(what);
}

void PtuSteadyState::fail(Trouble::Kind kind, std::string reason) {
  if (!trouble_) trouble_ = Trouble{kind, std::move(reason)};
}

void PtuSteadyState::unit_restarted() {
  fail(Trouble::Kind::kRestarted, "the unit lost power, or homed");
}

void PtuSteadyState::take(const PtuReply& reply, double time_s, double late_s) {
  if (reply.limit_hits >= kHomingHits) {
    unit_restarted();
  } else if (!polling_.under_way()) {
    ++counters_.garbled;
    note_corrected(kDisturbedLine, time_s);
    polling_.unexpected_reply();
  } else if (const auto done = polling_.take(reply, late_s)) {
    finish(*done, time_s);
  }
}

void PtuSteadyState::finish(const PollCycle& done, double time_s) {
  if (done.command_lost()) {
    ++counters_.garbled;
    send_all_again(kDisturbedLine, time_s);
  }
  judge_refusals(done.refusals(), time_s);
  judge_modes(done);
  if (environment_.asked && !done.answers().empty()) {
    const auto said = ptu_environment(done.answers().front().text);
    if (said) environment_.newest = said;
  }
  // Echoes delay the replies, so the instants of these positions are not known.
  if (!done.modes_forgotten()) take_angles(done, time_s);
}

void PtuSteadyState::take_angles(const PollCycle& done, double time_s) {
  switch (angles_.take(done, commands_.speed_change_rad_s(), time_s)) {
    case PositionCheck::Verdict::kFirst:
    case PositionCheck::Verdict::kLate:
    case PositionCheck::Verdict::kBelieved:
      waiting_since_s_.reset();
      break;
    case PositionCheck::Verdict::kRefused:
      ++counters_.refused_positions;
      send_all_again("positions that contradict each other", time_s);
      break;
  }
}

void PtuSteadyState::judge_modes(const PollCycle& done) {
  switch (modes_.take(done)) {
    case ModeCheck::Result::kUnchanged:
      break;
    case ModeCheck::Result::kForgotten:
      ++counters_.echoes;
      break;
    case ModeCheck::Result::kRestored:
      commands_.send_all_again();
      break;
    case ModeCheck::Result::kUnitRestarted:
      fail(Trouble::Kind::kRestarted, "the unit has forgotten its modes");
      break;
  }
}

void PtuSteadyState::judge_refusals(const std::vector<std::string>& refusals, double time_s) {
  for (const std::string& text : refusals) {
    ++counters_.errors;
    send_all_again(text, time_s);
    const PtuComplaint what = complaint(text);
    if (what == PtuComplaint::kNotReferenced) fail(Trouble::Kind::kNotReferenced, text);
    const bool bounds = what == PtuComplaint::kPositionLimit || what == PtuComplaint::kSpeedLimit;
    if (!bounds) continue;
    // A single one may be a command corrupted on the line.
    if (time_s - bounds_refused_.last_s > kBoundsRefused_s) bounds_refused_.times = 0;
    bounds_refused_.last_s = time_s;
    if (++bounds_refused_.times >= kBoundsRefused) {
      fail(Trouble::Kind::kNotItself, "the unit's bounds have changed: " + text);
    }
  }
}

}  // namespace ols::ptu
