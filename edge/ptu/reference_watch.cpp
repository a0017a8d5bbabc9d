#include "edge/ptu/reference_watch.h"

#include <cmath>

namespace ols::ptu {

namespace {

constexpr double kBetweenEnds_s = 15.0;  // the slowest axis from one end to the other
constexpr double kSameStep = 0.01;       // relative difference

}  // namespace

void ReferenceWatch::while_driven(const PtuLimitHits& hits, bool homing) {
  if (homing) {
    ends_ += hits;
  } else if (hits.any() && !doubt_) {
    doubt_for(PtuDoubtCause::kLimitHit);
  }
}

void ReferenceWatch::while_not_driven(const PtuLimitHits& hits, int baud, double time_s) {
  if (!hits.any()) return;
  Heard& heard = heard_[baud];
  heard.hits += hits;
  heard.time_s = time_s;
}

void ReferenceWatch::rate_is(int baud) {
  const auto heard = heard_.find(baud);
  if (heard != heard_.end()) ends_ += heard->second.hits;
  heard_.clear();
}

std::optional<int> ReferenceWatch::homes_at(double time_s) const {
  for (const auto& [baud, heard] : heard_) {
    if (time_s - heard.time_s < kBetweenEnds_s) return baud;
  }
  return std::nullopt;
}

void ReferenceWatch::power_cycled() {
  if (!doubt_ || !doubt_->persisted.homing_broken_off) doubt_for(PtuDoubtCause::kPowerCycle);
}

void ReferenceWatch::homing_ordered() {
  heard_.clear();
  ends_ = {};
  complete_ = false;
}

bool ReferenceWatch::saw_both_ends() const {
  PtuLimitHits hits = ends_;
  for (const auto& [baud, heard] : heard_) hits += heard.hits;
  return hits.pan > 0 && hits.tilt > 0;
}

void ReferenceWatch::homing_interrupted() {
  homing_ordered();
  doubt_for(PtuDoubtCause::kHomingInterrupted).persisted.homing_broken_off = true;
}

void ReferenceWatch::step_is(double pan_step_rad) {
  step_rad_ = pan_step_rad;
  if (trusted_step_rad_ <= 0.0) trusted_step_rad_ = pan_step_rad;
  if (std::abs(pan_step_rad / trusted_step_rad_ - 1.0) <= kSameStep) return;
  if (!doubt_) power_cycled();
  doubt_->persisted.gears_lost = true;
}

void ReferenceWatch::ready() {
  const bool homed = ends_.pan > 0 && ends_.tilt > 0;
  const bool broken_off = doubt_ && doubt_->persisted.homing_broken_off;
  if (homed && (complete_ || !broken_off)) {
    doubt_.reset();
  } else if (was_ready_ && ends_.any() && !doubt_) {
    doubt_for(PtuDoubtCause::kLimitHit);
  }
  homing_ordered();
  was_ready_ = true;
  if (!doubt_) acknowledge();
}

void ReferenceWatch::acknowledge() {
  doubt_.reset();
  homed_since_trusted_ = false;
  trusted_step_rad_ = step_rad_;
}

std::optional<PtuDoubtCause> ReferenceWatch::cause() const {
  return doubt_ ? std::optional(doubt_->cause) : std::nullopt;
}

std::optional<mount::ReferenceDoubt> ReferenceWatch::doubt() const {
  return doubt_ ? std::optional(doubt_->persisted) : std::nullopt;
}

bool ReferenceWatch::may_home_automatically() const {
  return !homed_since_trusted_ && !(doubt_ && doubt_->persisted.homing_broken_off);
}

// A newer cause replaces an older one; the rest of the doubt stays.
ReferenceWatch::Doubt& ReferenceWatch::doubt_for(PtuDoubtCause cause) {
  if (!doubt_) doubt_ = Doubt{};
  doubt_->cause = cause;
  return *doubt_;
}

}  // namespace ols::ptu
