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
  explicit PositionCheck(const PtuFacts& facts) : pan_{facts.pan}, tilt_{facts.tilt} {}

  enum class Verdict {
    kFirst,     // nothing to hold it against yet; the next one will be held against it
    kBelieved,  // sample() is it
    kRefused,
    kLate,  // the replies were read so late that they say nothing of when: this host was busy
  };
  Verdict take(const PtuReadings& pan, const PtuReadings& tilt);
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
  };
  struct Axis {
    PtuAxisFacts facts;
    std::optional<Merged> last = {};
    double rate_counts_s = 0.0;
    bool rate_known = false;
    double gap_s = 0.0;  // over which the rate was seen
  };
  static Merged middle(const PtuReadings& readings);
  static bool reachable(const Axis& axis, const Merged& now);
  static std::optional<Merged> merged(const Axis& axis, const PtuReadings& readings);
  static void remember(Axis& axis, const Merged& now);

  Axis pan_, tilt_;
  AngleSample sample_;
};

}  // namespace ols
