#include "edge/ptu/ptu_handover.h"

#include "base/process/clocks.h"
#include "edge/ptu/ptu_report.h"

namespace ols::ptu {

PtuHandover::PtuHandover(const PtuConfig& config) : config_(config), driver_(config) {
  driver_.allow_rehoming(false);
}

void PtuHandover::set_goal(const std::optional<mount::Goal>& goal) {
  const std::lock_guard lock(mutex_);
  driver_.set_goal(emergency_ ? std::nullopt : goal);
}

std::vector<mount::AngleSample> PtuHandover::take_samples() {
  const std::lock_guard lock(mutex_);
  return driver_.take_samples();
}

std::optional<mount::Limits> PtuHandover::limits() const {
  const std::lock_guard lock(mutex_);
  if (!link().is_open || driver_.state() != PtuState::kReady) return std::nullopt;
  return driver_.limits();
}

// Without the lock: it must not wait for the thread.
void PtuHandover::emergency_halt() {
  emergency_ = true;
  halt_wanted_ = true;
  wake();
}

void PtuHandover::clear_emergency() {
  const std::lock_guard lock(mutex_);
  emergency_ = false;
  driver_.clear_emergency();
}

void PtuHandover::home() {
  const std::lock_guard lock(mutex_);
  if (!emergency_) driver_.home(clock_monotonic_s());
}

void PtuHandover::stop_homing() {
  const std::lock_guard lock(mutex_);
  driver_.stop_homing(clock_monotonic_s());
}

void PtuHandover::allow_rehoming(bool allowed) {
  const std::lock_guard lock(mutex_);
  driver_.allow_rehoming(allowed);
}

void PtuHandover::restore_doubt(const std::optional<mount::ReferenceDoubt>& doubt) {
  const std::lock_guard lock(mutex_);
  driver_.restore_doubt(doubt);
}

void PtuHandover::reference_ok() {
  const std::lock_guard lock(mutex_);
  driver_.reference_ok();
}

mount::Reference PtuHandover::reference() const {
  const std::lock_guard lock(mutex_);
  return link().is_open ? driver_.reference() : mount::Reference::kUnknown;
}

std::uint64_t PtuHandover::homings() const {
  const std::lock_guard lock(mutex_);
  return driver_.counters().homings;
}

std::optional<mount::ReferenceDoubt> PtuHandover::doubt_to_persist() const {
  const std::lock_guard lock(mutex_);
  return driver_.doubt_to_persist();
}

PtuStatus PtuHandover::status() const {
  const std::lock_guard lock(mutex_);
  PtuStatus status;
  const device::DeviceThread::Link line = link();
  status.port = {line.is_open, line.failures, reopens_};
  status.state = line.is_open || line.failures == 0 ? driver_.state() : PtuState::kFault;
  status.emergency = emergency_;
  status.standing = driver_.standing();
  status.not_referenced = driver_.not_referenced();
  status.homing = driver_.homing();
  status.doubt = driver_.doubt();
  status.lowered_speed = driver_.lowered_speed();
  status.line_baud = driver_.line_baud();
  status.last_good_s = driver_.last_good_s();
  status.environment = driver_.environment();
  status.counters = driver_.counters();
  status.limits = driver_.limits();
  status.firmware = driver_.firmware();
  status.last_error = line.is_open ? driver_.last_error() : line.failure;
  return status;
}

device::DeviceReport PtuHandover::report() const {
  return ptu_report(config_, status(), clock_monotonic_s());
}

PtuHandover::Turn PtuHandover::turn(const std::string& arrived) {
  const std::lock_guard lock(mutex_);
  Turn turn;
  driver_.receive(arrived, clock_monotonic_s());
  if (!halt_wanted_) turn.request = driver_.step(clock_monotonic_s());
  turn.baud = driver_.line_baud();
  turn.link_lost = driver_.take_link_loss();
  reopens_ += turn.link_lost ? 1 : 0;
  return turn;
}

std::optional<std::string> PtuHandover::take_halt() {
  if (!halt_wanted_.exchange(false)) return std::nullopt;
  const std::lock_guard lock(mutex_);
  std::string halt = driver_.emergency_halt(clock_monotonic_s());
  if (!emergency_) driver_.clear_emergency();  // already cleared; the halt is sent all the same
  return halt;
}

int PtuHandover::line_baud() const {
  const std::lock_guard lock(mutex_);
  return driver_.line_baud();
}

void PtuHandover::restart() {
  const std::lock_guard lock(mutex_);
  driver_.restart(clock_monotonic_s());
}

}  // namespace ols::ptu
