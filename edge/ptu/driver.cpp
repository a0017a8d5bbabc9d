// The way to a unit that is ready, and back to it when it was lost. What happens then is in
// edge/ptu/steady_state.*, the line's budget in edge/ptu/budget.h.
#include "edge/ptu/driver.h"

#include <algorithm>
#include <utility>

#include "edge/ptu/budget.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/motion_commands.h"
#include "edge/ptu/start_sequence.h"
#include "edge/ptu/steady_state.h"

namespace ols {

namespace {

constexpr double kQuiet_s = 0.06;        // silence that ends a flush
constexpr double kLongestFlush_s = 2.0;  // a line that is not silent after so long is not a PTU's
constexpr double kFirstPause_s = 0.25;   // after a fault; doubles
constexpr double kLongestPause_s = 1.0;  // with the other rate tried in between, healed in 4 s
constexpr double kLongestHoming_s = 90.0;
constexpr int kRetries = 2;  // of a question of the start that was not answered

}  // namespace

struct PtuDriver::Impl {
  enum class Phase { kFlush, kStart, kHoming, kReady, kPause };

  explicit Impl(const PtuConfig& ptu_config) : config(ptu_config), baud(ptu_config.baud) {}

  double byte_s() const { return byte_time_s(baud); }

  // --- the way to ready -----------------------------------------------------------------------
  void begin(double time_s) {
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

  void begin_flush(double time_s) {
    phase = Phase::kFlush;
    parser.reset();
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
    phase = Phase::kPause;
    resume_s = time_s + pause_s;
    pause_s = std::min(2.0 * pause_s, kLongestPause_s);
  }

  // Nobody answers at this rate: the other one is tried next.
  void change_rate() {
    if (!answered) baud = baud == config.baud ? config.line_baud : config.baud;
  }

  std::string step_flush(double time_s) {
    if (!flush_sent) {
      flush_sent = true;
      last_byte_s = time_s;
      return emergency ? halt_request() : " ";  // ends half a command in the unit's buffer
    }
    if (time_s - last_byte_s >= kQuiet_s + byte_s()) {
      parser.reset();
      phase = Phase::kStart;
    } else if (time_s - flush_began_s > kLongestFlush_s) {
      fault(time_s, "the line does not fall silent");
      change_rate();
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
      change_rate();
    }
    return {};
  }

  void take_start_reply(const PtuReply& reply, double time_s) {
    if (!outstanding) return;
    outstanding = false;
    if (!answered && was_ready && baud != config.baud) note_power_cycle();
    answered = true;
    if (!reply.ok) ++counters.errors;
    if (!start->take(reply)) {
      fault(time_s, start->refusal(reply));
      unreferenced = start->not_referenced();
      if (unreferenced) consider_homing(time_s);
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
    steady = std::make_unique<PtuSteadyState>(config, start->facts(), byte_s(), time_s, counters);
    phase = Phase::kReady;
    pause_s = kFirstPause_s;
    unreferenced = homed = false;
    was_ready = true;
    limit_hits_at_start = parser.limit_hits();
    banners_at_start = parser.banners();
  }

  // It has another rate than it was left with, says its name, or has forgotten its modes.
  void note_power_cycle() {
    ++counters.power_cycles;
    limit_hits_at_power_up = parser.limit_hits();
  }

  // --- homing -----------------------------------------------------------------------------------
  void consider_homing(double time_s) {
    if (config.rehome != PtuRehome::kWhenUnreferenced || homed || emergency) return;
    homed = true;
    ++counters.homings;
    phase = Phase::kHoming;
    outstanding = false;
    sent_s = time_s;
  }

  std::string step_homing(double time_s) {
    if (!outstanding) {
      outstanding = true;
      sent_s = time_s;
      return " R ";
    }
    if (time_s - sent_s > kLongestHoming_s) fault(time_s, "homing does not end");
    return {};
  }

  // --- ready ------------------------------------------------------------------------------------
  std::string step_ready(double time_s) {
    std::string bytes = steady->step(goal, emergency, time_s);
    heed_trouble(time_s);
    return bytes;
  }

  void heed_trouble(double time_s) {
    if (!steady || !steady->trouble()) return;
    using Kind = PtuSteadyState::Trouble::Kind;
    const PtuSteadyState::Trouble trouble = *steady->trouble();
    fault(time_s, trouble.reason);
    link_lost = link_lost || trouble.kind == Kind::kNoReply;
    if (trouble.kind == Kind::kBeganAnew) note_power_cycle();
    unreferenced = trouble.kind == Kind::kNotReferenced;
    if (unreferenced) consider_homing(time_s);
  }

  std::string step(double time_s) {
    if (!urgent.empty()) return std::exchange(urgent, {});
    switch (phase) {
      case Phase::kPause:
        if (time_s >= resume_s) begin(time_s);
        return {};
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
      if (outstanding) begin(time_s);
    } else if (phase == Phase::kReady) {
      steady->take(reply, time_s, late_s);
    }
  }

  PtuConfig config;
  int baud;
  Phase phase = Phase::kPause;
  PtuReplyParser parser;
  std::unique_ptr<PtuStartSequence> start;
  std::unique_ptr<PtuSteadyState> steady;
  std::optional<ServoGoal> goal;
  PtuCounters counters;
  std::string error, urgent;
  bool emergency = false, link_lost = false, unreferenced = false, homed = false;
  bool outstanding = false, flush_sent = false;
  bool answered = false;  // since begin(), at this rate
  int retries = 0;
  double called_s = 0.0;  // all bytes of before were read then
  double last_unread_s = 0.0;
  double late_s = 0.0;  // so long bytes may lie unread: the last two pauses between calls
  double sent_s = 0.0, flush_began_s = 0.0, last_byte_s = 0.0;
  double resume_s = 0.0, pause_s = kFirstPause_s;
  bool was_ready = false;
  std::optional<std::uint64_t> limit_hits_at_power_up;  // of one in mid-run
  std::uint64_t limit_hits_at_start = 0, banners_at_start = 0;
};

PtuDriver::PtuDriver(const PtuConfig& config) : impl_(std::make_unique<Impl>(config)) {}
PtuDriver::~PtuDriver() = default;
PtuDriver::PtuDriver(PtuDriver&&) noexcept = default;

void PtuDriver::receive(std::string_view bytes, double time_s) {
  Impl& d = *impl_;
  d.note_call(time_s);
  if (bytes.empty()) return;
  d.last_byte_s = std::max(d.last_byte_s, time_s);
  if (d.steady) d.steady->bytes_came(time_s);
  const std::uint64_t garbled = d.parser.garbled();
  for (const PtuReply& reply : d.parser.feed(bytes, time_s, d.byte_s())) d.take(reply, time_s);
  const std::uint64_t more = d.parser.garbled() - garbled;
  // What stands in the line at the start, a banner for example, is nobody's fault.
  if (d.phase != Impl::Phase::kFlush) d.counters.garbled += more;
  if (d.steady && more > 0) d.steady->line_was_garbled();
  if (d.steady && d.parser.banners() != d.banners_at_start) d.steady->unit_began_anew();
  d.counters.limit_hits = d.parser.limit_hits();
  d.heed_trouble(time_s);
}

std::string PtuDriver::step(double time_s) { return impl_->step(time_s); }

int PtuDriver::line_baud() const { return impl_->baud; }

void PtuDriver::set_goal(const std::optional<ServoGoal>& goal) {
  const bool heeded = impl_->steady && !impl_->emergency;
  impl_->goal = heeded ? goal : std::nullopt;
}

std::string PtuDriver::emergency_halt(double time_s) {
  if (!impl_->emergency) ++impl_->counters.emergencies;
  impl_->emergency = true;
  impl_->goal.reset();
  impl_->urgent.clear();
  if (impl_->steady) impl_->steady->abandon(time_s);
  if (impl_->phase == Impl::Phase::kStart) impl_->begin_flush(time_s);
  if (impl_->phase == Impl::Phase::kHoming) impl_->begin(time_s);
  return halt_request();
}

void PtuDriver::clear_emergency() { impl_->emergency = false; }

bool PtuDriver::in_emergency() const { return impl_->emergency; }

void PtuDriver::restart(double time_s) {
  if (impl_->start) ++impl_->counters.restarts;
  impl_->begin(time_s);
}

bool PtuDriver::take_link_loss() { return std::exchange(impl_->link_lost, false); }

std::vector<AngleSample> PtuDriver::take_samples() {
  return impl_->steady ? impl_->steady->take_samples() : std::vector<AngleSample>{};
}

PtuState PtuDriver::state() const {
  switch (impl_->phase) {
    case Impl::Phase::kReady:
      return PtuState::kReady;
    case Impl::Phase::kPause:
      return impl_->start ? PtuState::kFault : PtuState::kStarting;
    default:
      return PtuState::kStarting;
  }
}

const PtuCounters& PtuDriver::counters() const { return impl_->counters; }

const PtuLimits& PtuDriver::limits() const {
  return impl_->steady ? impl_->steady->limits() : impl_->config.limits;
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

std::string PtuDriver::last_error() const {
  const std::string mended = impl_->steady ? impl_->steady->last_error() : std::string();
  return mended.empty() ? impl_->error : mended;
}

std::optional<PtuEnvironment> PtuDriver::environment() const {
  return impl_->steady ? impl_->steady->environment() : std::nullopt;
}

std::optional<double> PtuDriver::last_good_s() const {
  return impl_->steady ? impl_->steady->last_good_s() : std::nullopt;
}

bool PtuDriver::not_referenced() const { return impl_->unreferenced; }

// Homing runs into both ends of both axes.
bool PtuDriver::may_have_lost_reference() const {
  constexpr std::uint64_t kEnds = 3;  // of four, for one that was lost on the line
  return impl_->limit_hits_at_power_up &&
         impl_->parser.limit_hits() < *impl_->limit_hits_at_power_up + kEnds;
}

bool PtuDriver::ran_into_limit() const {
  return impl_->steady && impl_->parser.limit_hits() != impl_->limit_hits_at_start;
}

bool PtuDriver::standing() const { return impl_->steady && impl_->steady->standing(); }

std::string PtuDriver::halt_request() {
  return " " + PtuRequest().plain("H").bytes();  // the blank ends half a command
}

}  // namespace ols
