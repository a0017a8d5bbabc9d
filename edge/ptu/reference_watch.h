// Whether a unit's counts still mean what they did. A unit that was switched off and on begins to
// count where it happens to stand; one that ran into a limit may have lost steps. Either way its
// angles, limits and regions are in a frame that nobody knows, until it was homed or a person
// vouches for it. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "edge/ptu/codec.h"

namespace ols {

enum class PtuDoubt { kNone, kPowerCycle, kLimitHit, kHomingInterrupted, kBefore };
// What is wrong and what to do; empty for kNone.
const char* words(PtuDoubt doubt);

// Homing runs into both ends of both axes and says so: `!T!T!P!P`. Of the four some may be lost on
// the line or said at another rate than was listened at; one of each axis is enough, because
// nothing else moves a unit that is not driven.
class ReferenceWatch {
 public:
  // Limit hits of a unit that is driven. `homing`: they came all at once, in one reply.
  void while_driven(const PtuLimitHits& hits, bool homing);
  // Limit hits of one that is not, heard at this rate of the line, which may be a wrong one.
  void while_not_driven(const PtuLimitHits& hits, int baud, double time_s);
  // The unit answers at this rate: what was heard at any other was noise.
  void rate_is(int baud);
  // A unit was heard to begin anew at this rate.
  void begins(int baud, double time_s) { heard_[baud].time_s = time_s; }
  // The rate at which a unit begins or homes: it will answer there when it is done.
  std::optional<int> homes_at(double time_s) const;

  void power_cycled() {
    if (!broken_) doubt_ = PtuDoubt::kPowerCycle;
  }
  // A homing of our own: it was asked for, the unit said that it is over, or it was left before.
  // After one that was broken off only a whole one of our own is believed: some units go on.
  void homing_ordered();
  bool saw_both_ends() const;  // since then
  void homing_over() { over_ = true; }
  void homing_interrupted();
  // When the process before this one ended, perhaps in the middle of a homing.
  void doubted_before(bool broken) {
    doubt_ = PtuDoubt::kBefore;
    broken_ = broken;
  }
  // It can be driven again. The first time it is believed: whoever set the station up saw to it.
  void ready();
  void acknowledge() {
    doubt_ = PtuDoubt::kNone;
    broken_ = false;
  }

  PtuDoubt doubt() const { return doubt_; }
  bool broken() const { return broken_; }  // a homing was, and none was whole since then

 private:
  struct Heard {
    PtuLimitHits hits;
    double time_s = 0.0;
  };
  PtuDoubt doubt_ = PtuDoubt::kNone;
  std::map<int, Heard> heard_;  // by rate of the line
  PtuLimitHits ends_;           // since it was ready, for certain
  bool over_ = false, broken_ = false;
  bool was_ready_ = false;
};

}  // namespace ols
