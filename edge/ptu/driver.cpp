#include "edge/ptu/driver.h"

#include <algorithm>

#include "edge/ptu/budget.h"
#include "edge/ptu/motion_commands.h"

namespace ols::ptu {

namespace {

// The other baud rate is tried between the pauses, so that a lost unit is found within 4 s.
constexpr double kMaxPause_s = 1.0;
constexpr double kHaltOut_s = 0.1;  // the halt goes out before the baud rate changes
constexpr double kMinHoming_s = 2.0, kMaxHoming_s = 90.0;

}  // namespace

void PtuDriver::receive(std::string_view bytes, double time_s) {
  read_delay_.note_call(time_s);
  if (bytes.empty()) return;
  if (auto* starting = std::get_if<PtuStarting>(&phase_)) starting->bytes_came(time_s);
  if (ready()) ready()->bytes_came(time_s);
  const std::uint64_t garbled = parser_.garbled(), banners = parser_.banners();
  const std::vector<PtuReply> replies = parser_.feed(bytes, time_s, byte_s());
  note_limit_hits(replies, time_s);
  for (const PtuReply& reply : replies) take(reply, time_s);
  const std::uint64_t more = parser_.garbled() - garbled;
  // Bytes on the line at the start, a banner for example, are not an error.
  const auto* starting = std::get_if<PtuStarting>(&phase_);
  if (!starting || !starting->flushing()) counters_.garbled += more;
  if (ready() && more > 0) ready()->line_was_garbled();
  if (ready() && parser_.banners() != banners) ready()->unit_restarted();
  counters_.limit_hits = parser_.limit_hits().pan + parser_.limit_hits().tilt;
  heed_trouble(time_s);
}

std::string PtuDriver::step(double time_s) {
  if (!urgent_.empty()) return std::exchange(urgent_, {});
  return std::visit([&](auto& phase) { return step(phase, time_s); }, phase_);
}

void PtuDriver::take(const PtuReply& reply, double time_s) {
  ++counters_.replies;
  if (auto* starting = std::get_if<PtuStarting>(&phase_)) {
    take(*starting, reply, time_s);
  } else if (auto* homing = std::get_if<Homing>(&phase_)) {
    take(*homing, reply, time_s);
  } else if (ready()) {
    ready()->take(reply, time_s, read_delay_.longest_s);
  }
}

std::string PtuDriver::step(NotStarted& /*phase*/, double time_s) {
  start(PtuStarting::Purpose::kDrive, time_s);
  return {};
}

void PtuDriver::start(PtuStarting::Purpose purpose, double time_s) {
  drop_line(time_s);
  leave_homing();
  const PtuStartOptions options{config_.acceleration_rad_s2,
                                baud_ == config_.baud ? 0 : config_.baud, config_.step_mode,
                                config_.hold_power, config_.move_power};
  phase_.emplace<PtuStarting>(options, config_.reply_timeout_s, purpose, time_s, counters_);
}

std::string PtuDriver::step(PtuStarting& phase, double time_s) {
  PtuStarting::Step result = phase.step(time_s, byte_s(), emergency_);
  switch (result.event) {
    case PtuStarting::Event::kNone:
      break;
    case PtuStarting::Event::kLineDropped:
      drop_line(time_s);
      break;
    case PtuStarting::Event::kLineNotQuiet:
      fault(time_s, "the unit keeps sending");
      change_rate(time_s);
      break;
    case PtuStarting::Event::kNoReply:
      fault(time_s, "no reply to " + phase.asked());
      link_lost_ = true;
      change_rate(time_s);
      break;
    case PtuStarting::Event::kComplete:
      become_ready(PtuFacts(phase.facts()), phase.purpose(), time_s);
      break;
  }
  return std::move(result.bytes);
}

void PtuDriver::take(PtuStarting& phase, const PtuReply& reply, double time_s) {
  if (!phase.waits_for_reply()) return;
  // A unit that lost power has another baud rate than it was left with, or echoes again.
  const bool forgot = baud_ != config_.baud || reply.echoed;
  const bool homed_itself = progress_ != Progress::kReady && config_.homes_at_power_up;
  if (!phase.answered() && forgot && !homed_itself) note_power_cycle();
  reference_.rate_is(baud_);
  if (!phase.take(reply)) {
    const bool wanted = phase.purpose() == PtuStarting::Purpose::kHome;
    const bool not_referenced = phase.not_referenced();
    fault(time_s, phase.refusal(reply));
    reference_.set_missing(not_referenced);
    if (not_referenced) home_if(wanted);
  } else if (phase.changed_baud()) {
    baud_ = config_.baud;
    drop_line(time_s);
    phase.flush(time_s);
  }
}

void PtuDriver::become_ready(const PtuFacts& facts, PtuStarting::Purpose purpose, double time_s) {
  if (std::string conflict = limits_conflict(config_.limits, facts); !conflict.empty()) {
    fault(time_s, std::move(conflict));
    return;
  }
  reference_.step_is(facts.pan.resolution_rad);
  const bool wanted = purpose == PtuStarting::Purpose::kHome;
  if (!wanted) reference_.ready();
  if ((wanted || doubt()) && home_if(wanted)) return;
  phase_.emplace<PtuSteadyState>(config_, facts, byte_s(), time_s, counters_);
  next_pause_s_ = kFirstPause_s;
  progress_ = Progress::kReady;
  reference_.set_missing(false);
}

std::string PtuDriver::step(Homing& phase, double time_s) {
  if (!phase.ordered_s) {
    phase.ordered_s = time_s;
    reference_.homing_ordered();
    return " R ";
  }
  if (time_s - *phase.ordered_s > kMaxHoming_s) fault(time_s, "homing did not finish in time");
  return {};
}

// The `*` of R comes after the limit hits of homing. A `*` without them does not prove a homing,
// and one that comes at once is the late reply to something else.
void PtuDriver::take(Homing& phase, const PtuReply& reply, double time_s) {
  if (!phase.ordered_s) return;
  if (!reply.ok) return fault(time_s, "homing refused: " + reply.text);
  const bool both = reference_.saw_both_ends();
  if (!both && time_s - *phase.ordered_s < kMinHoming_s) return;
  if (both) {
    reference_.homing_complete();
    phase.ordered_s.reset();
  }
  start(PtuStarting::Purpose::kDriveAfterHoming, time_s);
}

std::string PtuDriver::step(PtuSteadyState& phase, double time_s) {
  if (doubt()) {
    phase.set_goal(std::nullopt);
    if (may_rehome()) {
      home(time_s);
      return std::exchange(urgent_, {});
    }
  }
  std::string bytes = phase.step(emergency_, time_s);
  heed_trouble(time_s);
  return bytes;
}

std::string PtuDriver::step(Paused& phase, double time_s) {
  if (time_s >= phase.until_s) {
    start(PtuStarting::Purpose::kDrive, time_s);
  } else if (!phase.listening_baud && !phase.answered && progress_ == Progress::kReady &&
             time_s >= phase.since_s + kHaltOut_s) {
    drop_line(time_s);
    phase.listening_baud = reference_.homes_at(time_s).value_or(config_.line_baud);
  }
  return {};
}

// At the first of several faults in a row the unit is told to halt.
void PtuDriver::fault(double time_s, std::string reason) {
  error_ = std::move(reason);
  ++counters_.restarts;
  if (ready()) urgent_ = halt_request();
  leave_homing();
  const auto* starting = std::get_if<PtuStarting>(&phase_);
  const bool answered = !starting || starting->answered();
  phase_ = Paused{time_s, time_s + next_pause_s_, answered};
  progress_ = std::max(progress_, Progress::kFaulted);
  next_pause_s_ = std::min(2.0 * next_pause_s_, kMaxPause_s);
}

void PtuDriver::heed_trouble(double time_s) {
  if (!ready() || !ready()->trouble()) return;
  using Kind = PtuSteadyState::Trouble::Kind;
  const PtuSteadyState::Trouble trouble = *ready()->trouble();
  fault(time_s, trouble.reason);
  link_lost_ = link_lost_ || trouble.kind == Kind::kNoReply;
  if (trouble.kind == Kind::kRestarted) {
    note_power_cycle();
    reference_.restarts_at(baud_, time_s);
  }
  if (trouble.kind == Kind::kNotReferenced) {
    reference_.set_missing(true);
    home_if(false);
  }
}

// Drops an incomplete line; limit hits in it count at the baud rate until now.
void PtuDriver::drop_line(double time_s) {
  parser_.reset();
  note_limit_hits({}, time_s);
}

// No unit answers at this baud rate: the other one is next, unless a unit homes at this one.
void PtuDriver::change_rate(double time_s) {
  drop_line(time_s);
  if (std::get<Paused>(phase_).answered) return;
  const int other = baud_ == config_.baud ? config_.line_baud : config_.baud;
  baud_ = reference_.homes_at(time_s).value_or(other);
}

// In a pause the port has the rate at which a unit that was switched on homes and reports it.
int PtuDriver::line_baud() const {
  const auto* paused = std::get_if<Paused>(&phase_);
  return paused ? paused->listening_baud.value_or(baud_) : baud_;
}

double PtuDriver::byte_s() const { return byte_time_s(baud_); }

// Called before the replies that came with the hits are processed.
void PtuDriver::note_limit_hits(const std::vector<PtuReply>& replies, double time_s) {
  const PtuLimitHits hits = parser_.limit_hits() - hits_noted_;
  hits_noted_ = parser_.limit_hits();
  if (!ready()) {
    reference_.while_not_driven(hits, line_baud(), time_s);
    return;
  }
  const bool homing_hits = std::any_of(replies.begin(), replies.end(), [](const PtuReply& r) {
    return r.limit_hits >= PtuSteadyState::kHomingHits;
  });
  reference_.while_driven(hits, homing_hits);
}

void PtuDriver::note_power_cycle() {
  ++counters_.power_cycles;
  reference_.power_cycled();
}

bool PtuDriver::may_rehome() const {
  return config_.rehome == PtuRehome::kWhenUnreferenced && rehoming_allowed_ && !emergency_ &&
         reference_.may_home_automatically();
}

// `wanted`: a person ordered it; otherwise it depends on whether the unit may home automatically.
// The start sequence has halted the unit.
bool PtuDriver::home_if(bool wanted) {
  if (emergency_ || !(wanted || may_rehome())) return false;
  reference_.homing_decided();
  ++counters_.homings;
  phase_ = Homing{};
  return true;
}

void PtuDriver::home(double time_s) {
  if (emergency_ || std::holds_alternative<Homing>(phase_)) return;
  if (ready()) urgent_ = halt_request();
  start(PtuStarting::Purpose::kHome, time_s);
}

void PtuDriver::stop_homing(double time_s) {
  const bool under_way = std::holds_alternative<Homing>(phase_);
  give_up_homing(time_s);
  if (under_way) urgent_ = halt_request();
}

void PtuDriver::give_up_homing(double time_s) {
  if (auto* starting = std::get_if<PtuStarting>(&phase_)) starting->give_up_homing();
  if (std::holds_alternative<Homing>(phase_)) start(PtuStarting::Purpose::kDrive, time_s);
}

// After a homing was sent and abandoned, the position of the unit is unknown.
void PtuDriver::leave_homing() {
  const auto* homing = std::get_if<Homing>(&phase_);
  if (homing && homing->ordered_s) reference_.homing_interrupted();
}

void PtuDriver::set_goal(const std::optional<mount::Goal>& goal) {
  const bool accepted = reference() == mount::Reference::kTrusted && !emergency_;
  if (ready()) ready()->set_goal(accepted ? goal : std::nullopt);
}

std::string PtuDriver::emergency_halt(double time_s) {
  if (!emergency_) ++counters_.emergencies;
  emergency_ = true;
  urgent_.clear();
  if (ready()) {
    ready()->set_goal(std::nullopt);
    ready()->abandon(time_s);
  }
  if (auto* starting = std::get_if<PtuStarting>(&phase_); starting && !starting->flushing()) {
    drop_line(time_s);
    starting->flush(time_s);
  }
  give_up_homing(time_s);
  return halt_request();
}

void PtuDriver::reference_ok() {
  if (reference() == mount::Reference::kDoubted) reference_.acknowledge();
}

void PtuDriver::restore_doubt(const std::optional<mount::ReferenceDoubt>& doubt) {
  if (doubt) reference_.restore(*doubt);
}

// Abandons a pending homing: the port may have been missing for days.
void PtuDriver::restart(double time_s) {
  if (!std::holds_alternative<NotStarted>(phase_)) ++counters_.restarts;
  start(PtuStarting::Purpose::kDrive, time_s);
}

std::vector<mount::AngleSample> PtuDriver::take_samples() {
  if (!ready()) return {};
  std::vector<mount::AngleSample> samples = ready()->take_samples();
  if (reference() != mount::Reference::kTrusted) samples.clear();
  return samples;
}

// A fault lasts until the unit can be driven again.
PtuState PtuDriver::state() const {
  if (reference() == mount::Reference::kTrusted) return PtuState::kReady;
  return homing() || progress_ == Progress::kNone ? PtuState::kStarting : PtuState::kFault;
}

mount::Reference PtuDriver::reference() const {
  if (ready()) {
    const auto doubt = reference_.doubt();
    if (!doubt) return mount::Reference::kTrusted;
    return doubt->gears_lost ? mount::Reference::kMissing : mount::Reference::kDoubted;
  }
  return homing() || reference_.missing() ? mount::Reference::kMissing : mount::Reference::kUnknown;
}

bool PtuDriver::homing() const {
  const auto* starting = std::get_if<PtuStarting>(&phase_);
  return std::holds_alternative<Homing>(phase_) ||
         (starting && starting->purpose() != PtuStarting::Purpose::kDrive);
}

// A unit that must be homed is in doubt; should the process end while it homes, the homing counts
// as broken off.
std::optional<mount::ReferenceDoubt> PtuDriver::doubt_to_persist() const {
  std::optional<mount::ReferenceDoubt> doubt = reference_.doubt();
  if (!doubt && reference() == mount::Reference::kMissing) doubt.emplace();
  if (doubt && homing()) doubt->homing_broken_off = true;
  return doubt;
}

bool PtuDriver::not_referenced() const {
  return reference_.missing() || (ready() && reference() == mount::Reference::kMissing);
}

const mount::Limits& PtuDriver::limits() const {
  return ready() ? ready()->limits() : config_.limits;
}

std::string PtuDriver::firmware() const {
  return ready() ? ready()->facts().firmware : std::string();
}

std::string PtuDriver::last_error() const {
  if (ready() && doubt()) return describe(*doubt());
  const std::string corrected = ready() ? ready()->last_error() : std::string();
  return corrected.empty() ? error_ : corrected;
}

std::optional<PtuEnvironment> PtuDriver::environment() const {
  return ready() ? ready()->environment() : std::nullopt;
}

std::optional<double> PtuDriver::last_good_s() const {
  return ready() ? ready()->last_good_s() : std::nullopt;
}

std::optional<PtuLoweredSpeed> PtuDriver::lowered_speed() const {
  return ready() ? ready()->lowered_speed() : std::nullopt;
}

bool PtuDriver::standing() const { return ready() && ready()->standing(); }

}  // namespace ols::ptu
