#include "edge/ptu/reference_watch.h"

namespace ols {

namespace {

constexpr double kBetweenEnds_s = 15.0;  // the slowest axis from one end to the other

}  // namespace

const char* words(PtuDoubt doubt) {
  switch (doubt) {
    case PtuDoubt::kNone:
      break;
    case PtuDoubt::kPowerCycle:
      return "was switched off and on and not seen to home itself: home it, or reference-ok once "
             "it was checked";
    case PtuDoubt::kLimitHit:
      return "ran into a limit and may have lost steps: home it, or reference-ok once it was "
             "checked";
    case PtuDoubt::kHomingInterrupted:
      return "its homing did not come to an end: home it, or reference-ok once it was checked";
    case PtuDoubt::kBefore:
      return "its reference was in doubt already before this start: home it, or reference-ok once "
             "it was checked";
  }
  return "";
}

void ReferenceWatch::while_driven(const PtuLimitHits& hits, bool homing) {
  if (homing) {
    ends_ += hits;
  } else if (hits.any() && doubt_ == PtuDoubt::kNone) {
    doubt_ = PtuDoubt::kLimitHit;
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

void ReferenceWatch::homing_ordered() {
  heard_.clear();
  ends_ = {};
  over_ = false;
}

bool ReferenceWatch::saw_both_ends() const {
  PtuLimitHits hits = ends_;
  for (const auto& [baud, heard] : heard_) hits += heard.hits;
  return hits.pan > 0 && hits.tilt > 0;
}

void ReferenceWatch::homing_interrupted() {
  homing_ordered();
  doubt_ = PtuDoubt::kHomingInterrupted;
  broken_ = true;
}

void ReferenceWatch::ready() {
  const bool homed = ends_.pan > 0 && ends_.tilt > 0;
  if (homed && (over_ || !broken_)) {
    acknowledge();
  } else if (was_ready_ && ends_.any() && doubt_ == PtuDoubt::kNone) {
    doubt_ = PtuDoubt::kLimitHit;
  }
  homing_ordered();
  was_ready_ = true;
}

}  // namespace ols
