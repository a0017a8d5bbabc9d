// Converts the positions that a unit reports to angle samples, if they are plausible. States the
// unit's present angles and rates. Pure.
#pragma once

#include <optional>
#include <vector>

#include "edge/device/reading_queue.h"
#include "edge/mount/angle_history.h"
#include "edge/ptu/driver_types.h"
#include "edge/ptu/poll_cycle.h"
#include "edge/ptu/position_check.h"
#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

class AngleIntake {
 public:
  AngleIntake(const PtuConfig& config, const PtuFacts& facts);

  // Notes that commands were sent which change the unit's speed by `change_rad_s`.
  void commanded(const PanTilt& change_rad_s);
  // Takes the positions of a complete poll cycle. `change_rad_s`: the change of speed by the
  // commands of this cycle, which the unit may not have executed yet.
  PositionCheck::Verdict take(const PollCycle& done, const PanTilt& change_rad_s, double time_s);

  // The angles at `time_s` or, if the samples do not cover it, the newest angles; nullopt before
  // the first sample.
  std::optional<PanTilt> angles_at(double time_s) const;
  std::optional<double> newest_s() const;  // time of the newest sample
  PanTilt rate_rad_s() const { return check_.rate_rad_s(); }
  bool standing() const { return check_.standing(); }

  std::vector<mount::AngleSample> take_samples() { return samples_.take(); }
  // The time at which the last accepted positions arrived.
  std::optional<double> last_good_s() const { return last_good_s_; }

 private:
  PanTilt commanded_rad_s2(double time_s) const;

  const double poll_interval_s_, acceleration_max_rad_s2_;
  PositionCheck check_;
  mount::AngleHistory history_;
  PanTilt change_rad_s_;  // largest commanded change of speed since the last sample
  device::ReadingQueue<mount::AngleSample> samples_;
  std::optional<double> last_good_s_;
};

}  // namespace ols::ptu
