#include "edge/ptu/driver.h"

#include <algorithm>
#include <utility>

#include "edge/ptu/driver_impl.h"

namespace ols {

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
  const std::vector<PtuReply> replies = d.parser.feed(bytes, time_s, d.byte_s());
  d.note_limit_hits(replies, time_s);
  for (const PtuReply& reply : replies) d.take(reply, time_s);
  const std::uint64_t more = d.parser.garbled() - garbled;
  // What stands in the line at the start, a banner for example, is nobody's fault.
  if (d.phase != Impl::Phase::kFlush) d.counters.garbled += more;
  if (d.steady && more > 0) d.steady->line_was_garbled();
  if (d.steady && d.parser.banners() != d.banners_at_start) d.steady->unit_began_anew();
  d.counters.limit_hits = d.parser.limit_hits().pan + d.parser.limit_hits().tilt;
  d.heed_trouble(time_s);
}

std::string PtuDriver::step(double time_s) { return impl_->step(time_s); }

int PtuDriver::line_baud() const { return impl_->line_rate(); }

void PtuDriver::set_goal(const std::optional<ServoGoal>& goal) {
  const bool heeded = reference() == PtuReference::kTrusted && !impl_->emergency;
  impl_->goal = heeded ? goal : std::nullopt;
}

std::string PtuDriver::emergency_halt(double time_s) {
  if (!impl_->emergency) ++impl_->counters.emergencies;
  impl_->emergency = true;
  impl_->goal.reset();
  impl_->urgent.clear();
  if (impl_->steady) impl_->steady->abandon(time_s);
  if (impl_->phase == Impl::Phase::kStart) impl_->begin_flush(time_s);
  impl_->give_up_homing(time_s);
  return halt_request();
}

void PtuDriver::clear_emergency() { impl_->emergency = false; }

bool PtuDriver::in_emergency() const { return impl_->emergency; }

void PtuDriver::home(double time_s) { impl_->want_home(time_s); }

void PtuDriver::stop_homing(double time_s) {
  const bool under_way = impl_->phase == Impl::Phase::kHoming;
  impl_->give_up_homing(time_s);
  if (under_way) impl_->urgent = halt_request();
}

void PtuDriver::allow_rehoming(bool allowed) { impl_->rehoming_allowed = allowed; }

void PtuDriver::inherit(PtuLegacy legacy) {
  if (legacy == PtuLegacy::kNone) return;
  const bool both = legacy == PtuLegacy::kBrokenHomingGearsLost;
  impl_->reference.doubted_before(both || legacy == PtuLegacy::kBrokenHoming);
  impl_->gears_lost = both || legacy == PtuLegacy::kGearsLost;
}

void PtuDriver::reference_ok() {
  if (reference() != PtuReference::kDoubted) return;
  impl_->reference.acknowledge();
  impl_->trust();
}

void PtuDriver::restart(double time_s) {
  if (impl_->start) ++impl_->counters.restarts;
  impl_->begin(time_s);
  impl_->home_wanted = impl_->homing = false;  // a port may come back days later
}

bool PtuDriver::take_link_loss() { return std::exchange(impl_->link_lost, false); }

std::vector<AngleSample> PtuDriver::take_samples() {
  if (!impl_->steady) return {};
  std::vector<AngleSample> samples = impl_->steady->take_samples();
  if (reference() != PtuReference::kTrusted) samples.clear();
  return samples;
}

// Whatever is tried after a fault: it is one until the unit can be driven again.
PtuState PtuDriver::state() const {
  const PtuReference worth = reference();
  if (worth == PtuReference::kTrusted) return PtuState::kReady;
  if (impl_->homing || !(impl_->failed || impl_->was_ready)) return PtuState::kStarting;
  return PtuState::kFault;
}

PtuReference PtuDriver::reference() const {
  if (impl_->phase == Impl::Phase::kReady) {
    if (doubt() == PtuDoubt::kNone) return PtuReference::kTrusted;
    return impl_->gears_lost ? PtuReference::kMissing : PtuReference::kDoubted;
  }
  return impl_->homing || impl_->unreferenced ? PtuReference::kMissing : PtuReference::kUnknown;
}

bool PtuDriver::homing() const { return impl_->homing; }

PtuDoubt PtuDriver::doubt() const { return impl_->reference.doubt(); }

PtuLegacy PtuDriver::legacy() const {
  const bool must_home = reference() == PtuReference::kMissing;
  const bool broken = impl_->reference.broken() || (must_home && impl_->homing);
  if (impl_->gears_lost) {
    return broken ? PtuLegacy::kBrokenHomingGearsLost : PtuLegacy::kGearsLost;
  }
  if (broken) return PtuLegacy::kBrokenHoming;
  return doubt() != PtuDoubt::kNone || must_home ? PtuLegacy::kDoubt : PtuLegacy::kNone;
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
  if (impl_->phase == Impl::Phase::kReady && doubt() != PtuDoubt::kNone) return words(doubt());
  const std::string mended = impl_->steady ? impl_->steady->last_error() : std::string();
  return mended.empty() ? impl_->error : mended;
}

std::optional<PtuEnvironment> PtuDriver::environment() const {
  return impl_->steady ? impl_->steady->environment() : std::nullopt;
}

std::optional<double> PtuDriver::last_good_s() const {
  return impl_->steady ? impl_->steady->last_good_s() : std::nullopt;
}

bool PtuDriver::not_referenced() const {
  return impl_->unreferenced ||
         (impl_->phase == Impl::Phase::kReady && reference() == PtuReference::kMissing);
}

std::optional<PtuLoweredSpeed> PtuDriver::lowered_speed() const {
  return impl_->steady ? impl_->steady->lowered_speed() : std::nullopt;
}

bool PtuDriver::standing() const { return impl_->steady && impl_->steady->standing(); }

std::string PtuDriver::halt_request() {
  return " " + PtuRequest().plain("H").bytes();  // the blank ends half a command
}

}  // namespace ols
