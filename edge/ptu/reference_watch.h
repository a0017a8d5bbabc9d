// Watches for events after which a unit's step counter may no longer match the position of its
// head. A unit that has lost power counts from the position where it stands. A unit that has run
// into a limit may have lost steps. In both cases, the zero of its angles, limits and keep-out
// regions is unknown until the unit is homed or an operator confirms the reference. Pure.
#pragma once

#include <map>
#include <optional>

#include "edge/mount/reference.h"
#include "edge/ptu/codec.h"
#include "edge/ptu/doubt_cause.h"

namespace ols::ptu {

// In homing, a unit runs into both ends of both axes and reports these limit hits: `!T!T!P!P`. Some
// of the four reports may be lost, because the line is disturbed or the port has another baud rate.
// One report from each axis suffices as evidence of a homing, because a unit without orders moves
// only by homing.
class ReferenceWatch {
 public:
  // Takes limit hits of a unit in service. `homing`: one reply contained several of them, as after
  // homing.
  void while_driven(const PtuLimitHits& hits, bool homing);
  // Takes limit hits of a unit that is not in service. They were read at the rate `baud`, which may
  // be wrong.
  void while_not_driven(const PtuLimitHits& hits, int baud, double time_s);
  // Notes that the unit answers at this baud rate. Limit hits that were read at other rates are
  // then discarded as noise.
  void rate_is(int baud);
  // Notes that a unit restarts; its messages came at this baud rate.
  void restarts_at(int baud, double time_s) { heard_[baud].time_s = time_s; }
  // The baud rate at which a unit was recently observed to restart or to home; nullopt if none was.
  // The unit will answer at this rate when it has finished.
  std::optional<int> homes_at(double time_s) const;

  void power_cycled();

  // The steps of a homing by the driver. homing_decided(): the driver will home the unit.
  // homing_ordered(): the driver has sent R. homing_complete(): the unit has reported the end.
  // homing_interrupted(): the driver has abandoned the homing. Then only a complete homing by the
  // driver restores the reference. Limit hits alone do not, because some units go on with the
  // abandoned homing.
  void homing_decided() { homed_since_trusted_ = true; }
  void homing_ordered();
  bool saw_both_ends() const;  // whether each axis has reported a limit hit since homing_ordered()
  void homing_complete() { complete_ = true; }
  void homing_interrupted();

  // Restores the doubt about the reference that an earlier process has saved.
  void restore(const mount::ReferenceDoubt& doubt) {
    doubt_ = {PtuDoubtCause::kBeforeStart, doubt};
  }
  // Takes the angle of a pan step, as the unit states it. If it has changed, the unit has lost
  // power.
  void step_is(double pan_step_rad);
  // Notes that the unit is ready. Limit hits on both axes since the last call are evidence of a
  // homing and restore the reference; other limit hits put it in doubt. At the first call, a unit
  // without doubt is trusted, because the installer has checked it.
  void ready();
  // Makes the reference trusted, because an operator has confirmed it.
  void acknowledge();
  // Sets whether the unit itself states that it must be homed.
  void set_missing(bool missing) { missing_ = missing; }
  bool missing() const { return missing_; }

  std::optional<PtuDoubtCause> cause() const;
  std::optional<mount::ReferenceDoubt> doubt() const;
  // True if no homing was decided since the reference was last trusted, and the doubt is not about
  // an interrupted homing.
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
  PtuLimitHits ends_;      // limit hits at the right baud rate since ready() or homing_ordered()
  bool complete_ = false;  // a homing by the driver was completed
  bool was_ready_ = false;
  bool missing_ = false;
  bool homed_since_trusted_ = false;
  double step_rad_ = 0.0;
  double trusted_step_rad_ = 0.0;  // 0 if it is not known yet
};

}  // namespace ols::ptu
