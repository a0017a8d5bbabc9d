// Checks reported positions. Replies have no checksum, so a wrong digit gives a plausible number.
// Pure.
//
// Each position is read twice in a cycle. The two readings must differ by the motion between their
// instants; an impossible pair is rejected. The readings of an accepted pair are averaged. The
// standard deviation of the average grows with the difference between the two, to cover an
// undetected error.
#pragma once

#include <optional>

#include "edge/mount/angle_history.h"
#include "edge/ptu/poll_cycle.h"
#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

class PositionCheck {
 public:
  // The first reading of pan is the first in the cycle, so nothing delays it. The errors of the two
  // instants of tilt are correlated, because the same work of the unit precedes both.
  explicit PositionCheck(const PtuFacts& facts) : pan_{facts.pan, 0.0}, tilt_{facts.tilt, 0.5} {}

  enum class Verdict {
    kFirst,     // there is nothing to compare it with yet
    kBelieved,  // accepted; sample() returns it
    kRefused,
    kLate,  // the replies were read too late to be dated, because this host was busy
  };
  // `commanded_rad_s2`: approximate acceleration that was commanded.
  Verdict take(const PtuReadings& pan, const PtuReadings& tilt, const PanTilt& commanded_rad_s2);
  const mount::AngleSample& sample() const { return sample_; }

  // The rate over the last two accepted pairs; 0 if it is not known.
  PanTilt rate_rad_s() const;
  // Whether both axes were seen to stand still.
  bool standing() const;

 private:
  struct Merged {
    // Time of the mean; half of the interval that contains its instant.
    double time_s = 0.0, half_s = 0.0;
    double time_sd_s = 0.0;
    double counts = 0.0;
    double doubt_counts = 0.0;
    double step_share = 1.0;  // as mount::AngleSample::step_share
  };
  struct Axis {
    PtuAxisFacts facts;
    double correlation;  // between the errors of both instants
    std::optional<Merged> last = {};
    double rate_counts_s = 0.0;
    bool rate_known = false;
    double gap_s = 0.0;  // time over which the rate was measured
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
