// Watches whether a unit's step counter still matches the position of its head. A unit that lost
// power counts from the position where it stands. A unit that ran into a limit may have lost steps.
// In both cases the zero of its angles, limits and keep-out regions is unknown until the unit is
// homed or an operator confirms the reference. Pure.
#pragma once

#include <map>
#include <optional>

#include "edge/mount/reference.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/doubt_cause.h"

namespace ols::ptu {

// A homing runs into both ends of both axes and reports them: `!T!T!P!P`. Some of the four reports
// may be lost on the line, or be sent at another baud rate than the port's. One report from each
// axis is enough, because a unit that is not driven moves only by homing.
class ReferenceWatch {
 public:
  // Takes limit hits of a unit that is driven. `homing`: several came in one reply, as from homing.
  void while_driven(const PtuLimitHits& hits, bool homing);
  // Takes limit hits of a unit that is not driven, read at this baud rate, which may be wrong.
  void while_not_driven(const PtuLimitHits& hits, int baud, double time_s);
  // Notes that the unit answers at this baud rate, so that bytes read at other rates were noise.
  void rate_is(int baud);
  // Notes that a unit was heard to restart at this baud rate.
  void restarts_at(int baud, double time_s) { heard_[baud].time_s = time_s; }
  // The baud rate at which a unit is restarting or homing. It will answer at this rate when it has
  // finished.
  std::optional<int> homes_at(double time_s) const;

  void power_cycled();

  // The steps of a homing by the driver. It is decided (homing_decided()); R is sent
  // (homing_ordered()); the unit reports completion (homing_complete()), or the driver abandons it
  // (homing_interrupted()). After an abandoned homing, only a complete homing by the driver
  // restores the reference, because some units carry the abandoned one to its end.
  void homing_decided() { homed_since_trusted_ = true; }
  void homing_ordered();
  bool saw_both_ends() const;  // since homing_ordered()
  void homing_complete() { complete_ = true; }
  void homing_interrupted();

  // Restores the doubt that an earlier process saved.
  void restore(const mount::ReferenceDoubt& doubt) {
    doubt_ = {PtuDoubtCause::kBeforeStart, doubt};
  }
  // Takes the pan step that the unit states. If it has changed, the unit has lost power.
  void step_is(double pan_step_rad);
  // Notes that the unit is ready. The first time, its reference is trusted, because the installer
  // has checked it.
  void ready();
  // Makes the reference trusted.
  void acknowledge();
  // Sets whether the unit itself reports that it must be homed.
  void set_missing(bool missing) { missing_ = missing; }
  bool missing() const { return missing_; }

  std::optional<PtuDoubtCause> cause() const;
  std::optional<mount::ReferenceDoubt> doubt() const;
  // True if, since the reference was last trusted, the unit has not been homed and no homing was
  // interrupted.
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
  std::map<int, Heard> heard_;  // for each baud rate
  PtuLimitHits ends_;           // hits since ready() or homing_ordered(), at the right baud rate
  bool complete_ = false;       // a homing by the driver was completed
  bool was_ready_ = false;
  bool missing_ = false;
  bool homed_since_trusted_ = false;
  double step_rad_ = 0.0;
  double trusted_step_rad_ = 0.0;  // 0 if it is not known yet
};

}  // namespace ols::ptu
