// Checks reported positions: replies carry no checksum, so a wrong digit gives a plausible number.
// Pure.
//
// Each position is read twice in a cycle. The two must differ by the motion between their instants;
// an impossible pair is rejected. An accepted pair is averaged. The standard deviation of the
// average grows with the difference of the two, so that it covers an error that was not detected.
#pragma once

#include <optional>

#include "edge/mount/angle_history.h"
#include "edge/ptu/poll_cycle.h"
#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

class PositionCheck {
 public:
  // The pan's first reading is the first of the cycle, so nothing delays it; the errors of the
  // tilt's two instants are correlated by the unit's work before them.
  explicit PositionCheck(const PtuFacts& facts) : pan_{facts.pan, 0.0}, tilt_{facts.tilt, 0.5} {}

  enum class Verdict {
    kFirst,     // nothing to compare it with yet
    kBelieved,  // sample() is it
    kRefused,
    kLate,  // the replies were read too late to date them: this host was busy
  };
  // `commanded_rad_s2`: the approximate commanded acceleration.
  Verdict take(const PtuReadings& pan, const PtuReadings& tilt, const PanTilt& commanded_rad_s2);
  const mount::AngleSample& sample() const { return sample_; }

  // The rate over the last two accepted pairs; 0 when not known.
  PanTilt rate_rad_s() const;
  // Whether both axes were seen not to move.
  bool standing() const;

 private:
  struct Merged {
    double time_s = 0.0, half_s = 0.0;  // of the mean; half of the interval that its instant is in
    double time_sd_s = 0.0;
    double counts = 0.0;
    double doubt_counts = 0.0;
    double step_share = 1.0;  // mount::AngleSample::step_share
  };
  struct Axis {
    PtuAxisFacts facts;
    double correlation;  // of the errors of both instants
    std::optional<Merged> last = {};
    double rate_counts_s = 0.0;
    bool rate_known = false;
    double gap_s = 0.0;  // over which the rate was seen
  };
  static Merged middle(const PtuReadings& readings);
  static bool reachable(const Axis& axis, const Merged& now);
  static std::optional<Merged> merged(const Axis& axis, const PtuReadings& readings,
                                      double commanded_rad_s2);
  static void remember(Axis& axis, const Merged& now);

  Axis pan_, tilt_;
  mount::AngleSample sample_;
};

}  // namespace ols::ptu
