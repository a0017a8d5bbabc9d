// The way to a unit that is ready, and back to it when it was lost; of driver.cpp alone. What
// happens then is in edge/ptu/steady_state.*, the line's budget in edge/ptu/budget.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edge/ptu/budget.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/driver.h"
#include "edge/ptu/motion_commands.h"
#include "edge/ptu/start_sequence.h"
#include "edge/ptu/steady_state.h"

namespace ols {

struct PtuDriver::Impl {
  static constexpr double kQuiet_s = 0.06;  // silence that ends a flush
  static constexpr double kLongestFlush_s =
      2.0;  // a line that is not silent after so long is not a PTU's
  static constexpr double kFirstPause_s = 0.25;  // after a fault; doubles
  static constexpr double kLongestPause_s =
      1.0;  // with the other rate tried in between, healed in 4 s
  static constexpr double kShortestHoming_s = 2.0, kLongestHoming_s = 90.0;
  static constexpr int kRetries = 2;  // of a question of the start that was not answered

  enum class Phase { kFlush, kStart, kHoming, kReady, kPause };

  explicit Impl(const PtuConfig& ptu_config) : config(ptu_config), baud(ptu_config.baud) {}

  double byte_s() const { return byte_time_s(baud); }

  // The rate that the port has now. In pauses it is the one at which a unit that was switched on
  // homes itself and says so.
  int line_rate() const { return listening.value_or(baud); }

  // --- the way to ready -----------------------------------------------------------------------
  void begin(double time_s) {
    end_line(time_s);
    leave_homing();
    listening.reset();
    steady.reset();
    goal.reset();
    const bool wanted_rate = baud == config.baud;
    start = std::make_unique<PtuStartSequence>(
        PtuStartOptions{config.acceleration_rad_s2, wanted_rate ? 0 : config.baud, config.step_mode,
                        config.hold_power, config.move_power});
    answered = false;
    retries = 0;
    begin_flush(time_s);
  }

  // What stands in an unfinished line was heard at the rate of until now.
  void end_line(double time_s) {
    parser.reset();
    note_limit_hits({}, time_s);
  }

  void begin_flush(double time_s) {
    end_line(time_s);
    phase = Phase::kFlush;
    outstanding = false;
    flush_sent = false;
    flush_began_s = last_byte_s = time_s;
  }

  // Once, at the first of several failures in a row, the unit is told to stand.
  void fault(double time_s, std::string reason) {
    error = std::move(reason);
    ++counters.restarts;
    if (steady) urgent = halt_request();
    steady.reset();
    goal.reset();
    failed = true;
    leave_homing();
    home_wanted = homing = false;
    phase = Phase::kPause;
    paused_s = time_s;
    resume_s = time_s + pause_s;
    pause_s = std::min(2.0 * pause_s, kLongestPause_s);
  }

  // Nobody answers at this rate: the other one is tried next, unless a unit homes at this one.
  void change_rate(double time_s) {
    end_line(time_s);
    if (answered) return;
    const int other = baud == config.baud ? config.line_baud : config.baud;
    baud = reference.homes_at(time_s).value_or(other);
  }

  std::string step_pause(double time_s) {
    constexpr double kHaltOut_s = 0.1;  // the halt goes out at the rate of before
    if (time_s >= resume_s) {
      begin(time_s);
    } else if (!listening && !answered && was_ready && time_s >= paused_s + kHaltOut_s) {
      end_line(time_s);
      listening = reference.homes_at(time_s).value_or(config.line_baud);
    }
    return {};
  }

  std::string step_flush(double time_s) {
    if (!flush_sent) {
      flush_sent = true;
      last_byte_s = time_s;
      return emergency ? halt_request() : " ";  // ends half a command in the unit's buffer
    }
    if (time_s - last_byte_s >= kQuiet_s + byte_s()) {
      end_line(time_s);
      phase = Phase::kStart;
    } else if (time_s - flush_began_s > kLongestFlush_s) {
      fault(time_s, "the line does not fall silent");
      change_rate(time_s);
    }
    return {};
  }

  std::string step_start(double time_s) {
    if (start->done()) {
      become_ready(time_s);
      return {};
    }
    if (!outstanding) {
      outstanding = true;
      sent_s = time_s;
      ++counters.requests;
      return start->request().bytes();
    }
    if (time_s - sent_s <= start->timeout_s(config.reply_timeout_s)) return {};
    ++counters.timeouts;
    if (answered && !start->slow() && retries++ < kRetries) {
      begin_flush(time_s);
    } else {
      const std::string asked = start->request().bytes();
      fault(time_s, "no reply to " + asked.substr(0, asked.size() - 1));
      link_lost = true;
      change_rate(time_s);
    }
    return {};
  }

  void take_start_reply(const PtuReply& reply, double time_s) {
    if (!outstanding) return;
    outstanding = false;
    // Whoever was switched on has another rate than it was left with, or echoes again.
    const bool forgot = baud != config.baud || reply.echoed;
    const bool trusted = was_ready ? false : config.homes_at_power_up;
    if (!answered && forgot && !trusted) note_power_cycle();
    answered = true;
    reference.rate_is(baud);
    if (!reply.ok) ++counters.errors;
    if (!start->take(reply)) {
      const bool wanted = home_wanted;
      fault(time_s, start->refusal(reply));
      unreferenced = start->not_referenced();
      if (unreferenced) home_if(wanted || may_home(), time_s);
    } else if (start->changed_baud()) {
      baud = config.baud;
      begin_flush(time_s);
    }
  }

  void become_ready(double time_s) {
    if (std::string conflict = limits_conflict(config.limits, start->facts()); !conflict.empty()) {
      fault(time_s, std::move(conflict));
      return;
    }
    if (!home_wanted) reference.ready();
    const bool in_doubt = reference.doubt() != PtuDoubt::kNone;
    if (home_if(home_wanted || (in_doubt && may_home()), time_s)) return;
    steady = std::make_unique<PtuSteadyState>(config, start->facts(), byte_s(), time_s, counters);
    phase = Phase::kReady;
    pause_s = kFirstPause_s;
    unreferenced = failed = homing = false;
    if (!in_doubt) {
      homed = false;
      trusted_step_rad = start->facts().pan.resolution_rad;
    }
    was_ready = true;
    banners_at_start = parser.banners();
  }

  // Some units do not know their gears before they are homed: nobody can vouch for their counts.
  bool scale_lost() const {
    constexpr double kSame = 0.01;
    const double step_rad = start->facts().pan.resolution_rad;
    return trusted_step_rad > 0.0 && std::abs(step_rad / trusted_step_rad - 1.0) > kSame;
  }

  // It has another rate than it was left with, says its name, or has forgotten its modes.
  void note_power_cycle() {
    ++counters.power_cycles;
    reference.power_cycled();
  }

  // --- homing -----------------------------------------------------------------------------------
  bool may_home() const {
    return config.rehome == PtuRehome::kWhenUnreferenced && rehoming_allowed && !homed &&
           !emergency;
  }

  // Only a unit that stands: the start sequence has halted it.
  bool home_if(bool wanted, double time_s) {
    home_wanted = false;
    if (!wanted || emergency) return false;
    homed = homing = true;
    ++counters.homings;
    phase = Phase::kHoming;
    outstanding = false;
    sent_s = time_s;
    return true;
  }

  void want_home(double time_s) {
    if (emergency || phase == Phase::kHoming) return;
    if (steady) urgent = halt_request();
    begin(time_s);
    home_wanted = homing = true;
  }

  void give_up_homing(double time_s) {
    home_wanted = homing = false;
    if (phase == Phase::kHoming) begin(time_s);
  }

  // Whoever leaves it before it is over has a unit that nobody knows where it is.
  void leave_homing() {
    if (phase == Phase::kHoming && outstanding) reference.homing_interrupted();
  }

  std::string step_homing(double time_s) {
    if (!outstanding) {
      outstanding = true;
      sent_s = time_s;
      reference.homing_ordered();
      return " R ";
    }
    if (time_s - sent_s > kLongestHoming_s) fault(time_s, "homing does not end");
    return {};
  }

  // Its `*` comes behind the limit hits. What comes at once is late and of something else; one
  // that comes without them proves nothing.
  void take_homing_reply(const PtuReply& reply, double time_s) {
    if (!outstanding) return;
    const bool both = reference.saw_both_ends();
    if (!reply.ok) return fault(time_s, "homing refused: " + reply.text);
    if (!both && time_s - sent_s < kShortestHoming_s) return;
    if (both) {
      reference.homing_over();
      outstanding = false;
    }
    begin(time_s);
  }

  // --- ready ------------------------------------------------------------------------------------
  std::string step_ready(double time_s) {
    if (reference.doubt() != PtuDoubt::kNone) {
      goal.reset();
      if (may_home()) {
        want_home(time_s);
        return std::exchange(urgent, {});
      }
    }
    std::string bytes = steady->step(goal, emergency, time_s);
    heed_trouble(time_s);
    return bytes;
  }

  // Before the replies are taken that came with them.
  void note_limit_hits(const std::vector<PtuReply>& replies, double time_s) {
    const PtuLimitHits hits = parser.limit_hits() - hits_noted;
    hits_noted = parser.limit_hits();
    if (phase != Phase::kReady) {
      reference.while_not_driven(hits, line_rate(), time_s);
      return;
    }
    const bool homing_hits = std::any_of(replies.begin(), replies.end(), [](const PtuReply& r) {
      return r.limit_hits >= PtuSteadyState::kHomingHits;
    });
    reference.while_driven(hits, homing_hits);
  }

  void heed_trouble(double time_s) {
    if (!steady || !steady->trouble()) return;
    using Kind = PtuSteadyState::Trouble::Kind;
    const PtuSteadyState::Trouble trouble = *steady->trouble();
    fault(time_s, trouble.reason);
    link_lost = link_lost || trouble.kind == Kind::kNoReply;
    if (trouble.kind == Kind::kBeganAnew) {
      note_power_cycle();
      reference.begins(baud, time_s);
    }
    unreferenced = trouble.kind == Kind::kNotReferenced;
    if (unreferenced) home_if(may_home(), time_s);
  }

  std::string step(double time_s) {
    if (!urgent.empty()) return std::exchange(urgent, {});
    switch (phase) {
      case Phase::kPause:
        return step_pause(time_s);
      case Phase::kFlush:
        return step_flush(time_s);
      case Phase::kStart:
        return step_start(time_s);
      case Phase::kHoming:
        return step_homing(time_s);
      case Phase::kReady:
        return step_ready(time_s);
    }
    return {};
  }

  void note_call(double time_s) {
    const double unread_s = std::max(0.0, time_s - called_s);
    late_s = std::max(unread_s, std::exchange(last_unread_s, unread_s));
    called_s = time_s;
  }

  void take(const PtuReply& reply, double time_s) {
    ++counters.replies;
    if (phase == Phase::kStart) {
      take_start_reply(reply, time_s);
    } else if (phase == Phase::kHoming) {
      take_homing_reply(reply, time_s);
    } else if (phase == Phase::kReady) {
      steady->take(reply, time_s, late_s);
    }
  }

  PtuConfig config;
  int baud;  // that is tried or in use
  Phase phase = Phase::kPause;
  PtuReplyParser parser;
  std::unique_ptr<PtuStartSequence> start;
  std::unique_ptr<PtuSteadyState> steady;
  std::optional<ServoGoal> goal;
  PtuCounters counters;
  ReferenceWatch reference;
  PtuLimitHits hits_noted;
  std::string error, urgent;
  bool emergency = false, link_lost = false, unreferenced = false, homed = false;
  bool rehoming_allowed = true;
  bool failed = false;           // since it was ready
  bool home_wanted = false;      // as soon as the unit stands
  bool homing = false;           // from then until it is ready
  std::optional<int> listening;  // line_rate() in a pause
  bool outstanding = false, flush_sent = false;
  bool answered = false;  // since begin(), at this rate
  int retries = 0;
  double called_s = 0.0;  // all bytes of before were read then
  double last_unread_s = 0.0;
  double late_s = 0.0;  // so long bytes may lie unread: the last two pauses between calls
  double sent_s = 0.0, flush_began_s = 0.0, last_byte_s = 0.0;
  double paused_s = 0.0, resume_s = 0.0, pause_s = kFirstPause_s;
  bool was_ready = false;
  double trusted_step_rad = 0.0;  // of a count of pan, when it was last trusted
  std::uint64_t banners_at_start = 0;
};

}  // namespace ols
