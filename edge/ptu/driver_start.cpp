// The way to a unit that is ready, and back to it when it was lost.
#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/ptu/driver_impl.h"
#include "edge/ptu/motion_commands.h"

namespace ols {

void PtuDriver::Impl::begin(double time_s) {
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
void PtuDriver::Impl::end_line(double time_s) {
  parser.reset();
  note_limit_hits({}, time_s);
}

void PtuDriver::Impl::begin_flush(double time_s) {
  end_line(time_s);
  phase = Phase::kFlush;
  outstanding = false;
  flush_sent = false;
  flush_began_s = last_byte_s = time_s;
}

// Once, at the first of several failures in a row, the unit is told to stand.
void PtuDriver::Impl::fault(double time_s, std::string reason) {
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
void PtuDriver::Impl::change_rate(double time_s) {
  end_line(time_s);
  if (answered) return;
  const int other = baud == config.baud ? config.line_baud : config.baud;
  baud = reference.homes_at(time_s).value_or(other);
}

std::string PtuDriver::Impl::step_pause(double time_s) {
  constexpr double kHaltOut_s = 0.1;  // the halt goes out at the rate of before
  if (time_s >= resume_s) {
    begin(time_s);
  } else if (!listening && !answered && was_ready && time_s >= paused_s + kHaltOut_s) {
    end_line(time_s);
    listening = reference.homes_at(time_s).value_or(config.line_baud);
  }
  return {};
}

std::string PtuDriver::Impl::step_flush(double time_s) {
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

std::string PtuDriver::Impl::step_start(double time_s) {
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

void PtuDriver::Impl::take_start_reply(const PtuReply& reply, double time_s) {
  if (!outstanding) return;
  outstanding = false;
  // Whoever was switched on has another rate than it was left with, or echoes again.
  const bool forgot = baud != config.baud || reply.echoed;
  const bool homed_itself = !was_ready && config.homes_at_power_up;
  if (!answered && forgot && !homed_itself) note_power_cycle();
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

void PtuDriver::Impl::become_ready(double time_s) {
  if (std::string conflict = limits_conflict(config.limits, start->facts()); !conflict.empty()) {
    fault(time_s, std::move(conflict));
    return;
  }
  note_gears();
  if (!home_wanted) reference.ready();
  const bool in_doubt = reference.doubt() != PtuDoubt::kNone;
  if (home_if(home_wanted || (in_doubt && may_home()), time_s)) return;
  steady = std::make_unique<PtuSteadyState>(config, start->facts(), byte_s(), time_s, counters);
  phase = Phase::kReady;
  pause_s = kFirstPause_s;
  unreferenced = failed = homing = false;
  if (!in_doubt) trust();
  was_ready = true;
  banners_at_start = parser.banners();
}

// Other steps than before are those of a unit that was switched off and on, if nobody saw it.
void PtuDriver::Impl::note_gears() {
  constexpr double kSame = 0.01;
  const double now_rad = start->facts().pan.resolution_rad;
  if (step_rad <= 0.0) step_rad = now_rad;
  if (std::abs(now_rad / step_rad - 1.0) <= kSame) return;
  gears_lost = true;
  if (reference.doubt() == PtuDoubt::kNone) reference.power_cycled();
}

void PtuDriver::Impl::trust() {
  homed = gears_lost = false;
  step_rad = start->facts().pan.resolution_rad;
}

// It has another rate than it was left with, says its name, or has forgotten its modes.
void PtuDriver::Impl::note_power_cycle() {
  ++counters.power_cycles;
  reference.power_cycled();
}

}  // namespace ols
