// The line's budget in steady state, one cycle:
//
//   PP TP PS18700 TS18700 PP-49467 TP-14622        out, 42 bytes
//      * -49467  * -14622  *  *  *  *              in, 32 bytes, the last 3 after the request's end
//
//   baud      request    cycle in motion, 1 ms of the unit's own    at rest (6 bytes, 20 bytes)
//   9600      43.8 ms    48 ms                                      26 ms
//   38400     10.9 ms    13 ms                                      7 ms
//   115200    3.6 ms     5 ms                                       3 ms
//
// One request is under way at a time, so that replies can be matched and a position's instant is
// known; the period is poll_interval_s or what the line takes, whichever is longer. Only commands
// that changed are sent. 25 ms in motion need 38400 baud.
#include "edge/ptu/driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/ptu/codec.h"
#include "edge/ptu/motion_commands.h"
#include "edge/ptu/poll_cycle.h"
#include "edge/ptu/start_sequence.h"

namespace ols {

namespace {

constexpr double kQuiet_s = 0.06;        // silence that ends a flush
constexpr double kLongestFlush_s = 2.0;  // a line that is not silent after so long is not a PTU's
constexpr double kReplySlack_s = 0.08;   // what a unit may take over one cycle
constexpr double kFirstPause_s = 0.25;   // after a fault; doubles
constexpr double kLongestPause_s = 4.0;
constexpr int kStrikes = 3;                 // wrong cycles in a row: the unit is not what it was
constexpr double kLatencyShare = 0.05;      // of a new one in the running average
constexpr std::size_t kSamplesKept = 1000;  // when nobody takes them

}  // namespace

struct PtuDriver::Impl {
  enum class Phase { kFlush, kStart, kReady, kResync, kPause };

  explicit Impl(const PtuConfig& ptu_config)
      : config(ptu_config),
        byte_s(config.baud > 0 ? 10.0 / config.baud : 0.0),
        history(config.history) {}

  // --- the way to ready -----------------------------------------------------------------------
  void begin_flush(Phase flush_phase, double time_s) {
    phase = flush_phase;
    parser.reset();
    cycle.reset();
    outstanding = false;
    flush_sent = false;
    flush_began_s = last_byte_s = time_s;
  }

  void begin(double time_s) {
    begin_flush(Phase::kFlush, time_s);
    start.emplace(config.acceleration_rad_s2);
    history.clear();
    strikes = 0;
  }

  void fault(double time_s, std::string reason) {
    error = std::move(reason);
    ++counters.restarts;
    phase = Phase::kPause;
    resume_s = time_s + pause_s;
    pause_s = std::min(2.0 * pause_s, kLongestPause_s);
  }

  std::string step_flush(double time_s) {
    if (!flush_sent) {
      flush_sent = true;
      last_byte_s = time_s;
      return " ";  // ends whatever half a command stands in the unit's buffer
    }
    if (time_s - last_byte_s >= kQuiet_s + byte_s) {
      parser.reset();
      phase = phase == Phase::kFlush ? Phase::kStart : Phase::kReady;
    } else if (time_s - flush_began_s > kLongestFlush_s) {
      fault(time_s, "the line does not fall silent");
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
    if (time_s - sent_s > start->timeout_s(config.reply_timeout_s)) {
      ++counters.timeouts;
      fault(time_s, "no reply to " + start->request().bytes());
    }
    return {};
  }

  void take_start_reply(const PtuReply& reply, double time_s) {
    if (!outstanding) return;
    outstanding = false;
    if (!reply.ok) ++counters.errors;
    if (!start->take(reply)) fault(time_s, start->refusal(reply));
  }

  void become_ready(double time_s) {
    if (std::string conflict = limits_conflict(config.limits, start->facts()); !conflict.empty()) {
      fault(time_s, std::move(conflict));
      return;
    }
    commands.emplace(config, start->facts());
    history = AngleHistory([this] {
      AngleHistory::Config history_config = config.history;
      history_config.step_rad = start->facts().pan.resolution_rad;
      return history_config;
    }());
    phase = Phase::kReady;
    pause_s = kFirstPause_s;
    last_good_s = next_poll_s = time_s;
  }

  // --- steady state ---------------------------------------------------------------------------
  std::string step_ready(double time_s) {
    if (cycle) {
      if (time_s > cycle->due_s(kReplySlack_s)) {
        ++counters.timeouts;
        wrong(time_s, "replies are missing");
      }
      return {};
    }
    if (time_s < next_poll_s) return {};
    next_poll_s = time_s + config.poll_interval_s;
    const auto now = history.at(time_s);
    const auto newest = history.newest();
    const PtuRequest request = now      ? commands->next(goal, now->angles, time_s)
                               : newest ? commands->next(goal, newest->angles, time_s)
                                        : PtuRequest();
    cycle.emplace(request, time_s, byte_s);
    ++counters.requests;
    return cycle->bytes();
  }

  void take_cycle_reply(const PtuReply& reply, double time_s) {
    if (!cycle) {
      wrong(time_s, "a reply to nothing");
      return;
    }
    // An echo: the unit was switched off and on, and has forgotten its modes.
    const auto outcome = reply.echoed ? PollCycle::Outcome::kWrong : cycle->take(reply);
    if (outcome == PollCycle::Outcome::kWrong) {
      ++counters.garbled;
      wrong(time_s, "reply out of step: " + reply.text);
      return;
    }
    if (outcome == PollCycle::Outcome::kRefused) {
      ++counters.errors;
      error = reply.text;
      commands->send_all_again();
    }
    if (cycle->complete()) finish_cycle(time_s);
  }

  void finish_cycle(double time_s) {
    const PollCycle done = std::move(*cycle);
    cycle.reset();
    if (!commands->plausible(done.pan_counts(), done.tilt_counts(), done.read_s(),
                             done.latency_s())) {
      ++counters.garbled;
      wrong(time_s, "a jump of the position");
      return;
    }
    strikes = 0;
    last_good_s = time_s;
    latency_s += (latency_s == 0.0 ? 1.0 : kLatencyShare) * (done.latency_s() - latency_s);
    const AngleSample sample = done.sample(start->facts(), commands->tilt_rate_rad_s(), latency_s);
    if (!history.add(sample)) return;
    if (samples.size() >= kSamplesKept) samples.erase(samples.begin());
    samples.push_back(sample);
  }

  // A cycle went wrong: drop what is under way; several in a row or too long a silence: begin
  // again.
  void wrong(double time_s, std::string reason) {
    error = std::move(reason);
    commands->send_all_again();
    if (++strikes >= kStrikes || time_s - last_good_s > config.reply_timeout_s) {
      fault(time_s, std::move(error));
    } else {
      begin_flush(Phase::kResync, time_s);
    }
  }

  std::string step(double time_s) {
    switch (phase) {
      case Phase::kPause:
        if (time_s >= resume_s) begin(time_s);
        return {};
      case Phase::kFlush:
      case Phase::kResync:
        return step_flush(time_s);
      case Phase::kStart:
        return step_start(time_s);
      case Phase::kReady:
        return step_ready(time_s);
    }
    return {};
  }

  PtuConfig config;
  double byte_s;
  Phase phase = Phase::kPause;
  PtuReplyParser parser;
  std::optional<PtuStartSequence> start;
  std::optional<MotionCommands> commands;
  std::optional<PollCycle> cycle;
  AngleHistory history;
  std::optional<ServoGoal> goal;
  std::vector<AngleSample> samples;
  PtuCounters counters;
  std::string error;
  bool outstanding = false, flush_sent = false;
  int strikes = 0;
  double sent_s = 0.0, flush_began_s = 0.0, last_byte_s = 0.0, last_good_s = 0.0;
  double latency_s = 0.0;  // running average of PollCycle::latency_s()
  double next_poll_s = 0.0, resume_s = 0.0, pause_s = kFirstPause_s;
};

PtuDriver::PtuDriver(const PtuConfig& config) : impl_(std::make_unique<Impl>(config)) {}
PtuDriver::~PtuDriver() = default;
PtuDriver::PtuDriver(PtuDriver&&) noexcept = default;

void PtuDriver::receive(std::string_view bytes, double time_s) {
  if (bytes.empty()) return;
  Impl& d = *impl_;
  d.last_byte_s = std::max(d.last_byte_s, time_s);
  const std::uint64_t garbled = d.parser.garbled();
  for (const PtuReply& reply : d.parser.feed(bytes, time_s, d.byte_s)) {
    ++d.counters.replies;
    if (d.phase == Impl::Phase::kStart) d.take_start_reply(reply, time_s);
    if (d.phase == Impl::Phase::kReady) d.take_cycle_reply(reply, time_s);
  }
  // What stands in the line at the start, a banner for example, is nobody's fault.
  if (d.phase != Impl::Phase::kFlush) d.counters.garbled += d.parser.garbled() - garbled;
  d.counters.limit_hits = d.parser.limit_hits();
}

std::string PtuDriver::step(double time_s) { return impl_->step(time_s); }

void PtuDriver::set_goal(const std::optional<ServoGoal>& goal) { impl_->goal = goal; }

void PtuDriver::restart(double time_s) {
  if (impl_->start) ++impl_->counters.restarts;
  impl_->begin(time_s);
}

std::vector<AngleSample> PtuDriver::take_samples() { return std::exchange(impl_->samples, {}); }

PtuState PtuDriver::state() const {
  switch (impl_->phase) {
    case Impl::Phase::kReady:
    case Impl::Phase::kResync:
      return PtuState::kReady;
    case Impl::Phase::kPause:
      return impl_->start ? PtuState::kFault : PtuState::kStarting;
    default:
      return PtuState::kStarting;
  }
}

const PtuCounters& PtuDriver::counters() const { return impl_->counters; }

const PtuLimits& PtuDriver::limits() const {
  return impl_->commands ? impl_->commands->limits() : impl_->config.limits;
}

double PtuDriver::pan_resolution_rad() const {
  return impl_->start ? impl_->start->facts().pan.resolution_rad : 0.0;
}

double PtuDriver::tilt_resolution_rad() const {
  return impl_->start ? impl_->start->facts().tilt.resolution_rad : 0.0;
}

std::string PtuDriver::firmware() const {
  return impl_->start ? impl_->start->facts().firmware : std::string();
}

std::string PtuDriver::last_error() const { return impl_->error; }

std::string PtuDriver::halt_request() {
  return " " + PtuRequest().plain("H").bytes();  // the blank ends half a command
}

}  // namespace ols
