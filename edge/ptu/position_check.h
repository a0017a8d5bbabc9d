// Believes positions or not: replies carry no checksum, so a wrong digit gives a plausible number.
// Pure.
//
// Each position is read twice in a cycle. The two must differ by what the unit moved between them,
// as far as their instants are known; a pair that cannot be is dropped. What passes is averaged,
// and the more the two disagree the less the average is believed: whatever went unnoticed is then
// within the standard deviation that goes with it.
#pragma once

#include <optional>

#include "edge/ptu/angle_history.h"
#include "edge/ptu/poll_cycle.h"
#include "edge/ptu/start_sequence.h"

namespace ols {

class PositionCheck {
 public:
  // The pan's first reading is the first of the cycle, with nothing in its way; the tilt's are
  // early or late together, by what the unit does before them.
  explicit PositionCheck(const PtuFacts& facts) : pan_{facts.pan, 0.0}, tilt_{facts.tilt, 0.5} {}

  enum class Verdict {
    kFirst,     // nothing to hold it against yet; the next one will be held against it
    kBelieved,  // sample() is it
    kRefused,
    kLate,  // the replies were read so late that they say nothing of when: this host was busy
  };
  // `told_rad_s2`: about as much as the unit was told to accelerate by.
  Verdict take(const PtuReadings& pan, const PtuReadings& tilt, const PanTilt& told_rad_s2);
  const AngleSample& sample() const { return sample_; }

  // As seen over the last two believed pairs; 0 when not known.
  PanTilt rate_rad_s() const;
  // Both axes were seen not to move.
  bool standing() const;

 private:
  struct Merged {
    double time_s = 0.0, half_s = 0.0;  // of the mean; half of the interval that its instant is in
    double time_sd_s = 0.0;
    double counts = 0.0;
    double doubt_counts = 0.0;
    double step_share = 1.0;  // AngleSample::step_share
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
                                      double told_rad_s2);
  static void remember(Axis& axis, const Merged& now);

  Axis pan_, tilt_;
  AngleSample sample_;
};

}  // namespace ols
