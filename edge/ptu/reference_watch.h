// Watches whether a unit's step counter still matches its head. A unit that lost power counts from
// its present position; a unit that ran into a limit may have lost steps. In both cases its angles,
// limits and keep-out regions are in an unknown frame until it was homed, or until an operator
// confirms the reference. Pure.
#pragma once

#include <map>
#include <optional>

#include "edge/mount/reference.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/doubt_cause.h"

namespace ols::ptu {

// A homing runs into both ends of both axes and reports them: `!T!T!P!P`. Some of the four reports
// may be lost on the line, or sent at another baud rate than the port's. One report of each axis is
// enough, because nothing else moves a unit that is not driven.
class ReferenceWatch {
 public:
  // Limit hits of a unit that is driven. `homing`: several came in one reply, as from a homing.
  void while_driven(const PtuLimitHits& hits, bool homing);
  // Limit hits of a unit that is not driven, read at this baud rate, which may be the wrong one.
  void while_not_driven(const PtuLimitHits& hits, int baud, double time_s);
  // The unit answers at this baud rate: bytes read at other rates were noise.
  void rate_is(int baud);
  // A unit was heard to restart at this baud rate.
  void restarts_at(int baud, double time_s) { heard_[baud].time_s = time_s; }
  // The baud rate at which a unit restarts or homes. It will answer at this rate when it has
  // finished.
  std::optional<int> homes_at(double time_s) const;

  void power_cycled();

  // The steps of a homing by the driver: it is decided; R is sent; the unit reports that it is
  // complete; or the driver abandons it. After an abandoned homing only a complete homing by the
  // driver restores the reference, because some units carry the abandoned one to its end.
  void homing_decided() { homed_since_trusted_ = true; }
  void homing_ordered();
  bool saw_both_ends() const;  // since homing_ordered()
  void homing_complete() { complete_ = true; }
  void homing_interrupted();

  // The doubt that an earlier process persisted.
  void restore(const mount::ReferenceDoubt& doubt) {
    doubt_ = {PtuDoubtCause::kBeforeStart, doubt};
  }
  // The unit states its pan step. A changed step means that it lost power.
  void step_is(double pan_step_rad);
  // The unit is ready. The first time its reference is trusted, because the installer has checked
  // it.
  void ready();
  // The reference is trusted.
  void acknowledge();
  // Whether the unit itself reports that it must be homed.
  void set_missing(bool missing) { missing_ = missing; }
  bool missing() const { return missing_; }

  std::optional<PtuDoubtCause> cause() const;
  std::optional<mount::ReferenceDoubt> doubt() const;
  // Whether, since the reference was last trusted, the unit was neither homed nor a homing broken
  // off.
  bool may_home_automatically() const;

 private:
  struct Heard {
    PtuLimitHits hits;
    double time_s = 0.0;
  };
  struct Doubt {
    PtuDoubtCause cause;
    mount::ReferenceDoubt persisted;
  };
  Doubt& doubt_for(PtuDoubtCause cause);

  std::optional<Doubt> doubt_;
  std::map<int, Heard> heard_;  // by baud rate
  PtuLimitHits ends_;           // since the unit was ready, read at the right baud rate
  bool complete_ = false;       // a homing by the driver
  bool was_ready_ = false;
  bool missing_ = false;
  bool homed_since_trusted_ = false;
  double step_rad_ = 0.0;
  double trusted_step_rad_ = 0.0;  // 0: not known yet
};

}  // namespace ols::ptu
