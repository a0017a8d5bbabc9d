// Checks reported positions. Replies have no checksum; a position with a wrong digit may therefore
// look plausible. Pure.
//
// Each position is read twice in a poll cycle. The two readings may differ only by the motion
// between their instants; an impossible pair is rejected. The readings of an accepted pair are
// averaged. If the two differ by more than noise explains, the standard deviation of the average is
// increased, to cover an undetected error.
#pragma once

#include <optional>

#include "edge/mount/angle_history.h"
#include "edge/ptu/poll_cycle.h"
#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

class PositionCheck {
 public:
  // 0 and 0.5 are the correlations between the time errors of an axis's two readings. Pan: no
  // correlation, because its first reading is the first of the cycle, and nothing delays it. Tilt:
  // the same work of the unit delays both readings.
  explicit PositionCheck(const PtuFacts& facts) : pan_{facts.pan, 0.0}, tilt_{facts.tilt, 0.5} {}

  enum class Verdict {
    kFirst,     // no earlier pair to compare with
    kBelieved,  // accepted; sample() returns the result
    kRefused,
    kLate,  // the computer was busy and read the replies so late that their times are not known
  };
  // Takes the readings of a cycle. `commanded_rad_s2`: approximate commanded acceleration.
  Verdict take(const PtuReadings& pan, const PtuReadings& tilt, const PanTilt& commanded_rad_s2);
  const mount::AngleSample& sample() const { return sample_; }

  // The rate between the last two accepted pairs; 0 before the second accepted pair, or if the two
  // pairs are 0.3 s or more apart.
  PanTilt rate_rad_s() const;
  // Whether the positions of both axes do not change.
  bool standing() const;

 private:
  struct Merged {
    // time_s: time of the mean. half_s: largest error of time_s.
    double time_s = 0.0, half_s = 0.0;
    double time_sd_s = 0.0;
    double counts = 0.0;
    double doubt_counts = 0.0;
    double step_share = 1.0;  // as mount::AngleSample::step_share
  };
  struct Axis {
    PtuAxisFacts facts;
    double correlation;  // between the time errors of the two readings
    std::optional<Merged> last = {};
    double rate_counts_s = 0.0;
    bool rate_known = false;
    double gap_s = 0.0;  // time interval over which the rate was measured
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
