// Converts goals to the commands of a poll cycle: either a halt, or those of the servo's positions
// and speeds [counts] that have changed. Pure.
#pragma once

#include <optional>
#include <string>

#include "edge/ptu/codec.h"
#include "edge/ptu/driver_types.h"
#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

// Names the axis for which the configured limits and the unit's own have no position in common,
// with the limits; empty if there is no such axis.
std::string limits_conflict(const mount::Limits& configured, const PtuFacts& facts);

class MotionCommands {
 public:
  // The limits in force are the narrower of the configured limits and the unit's own. There must be
  // no limits_conflict().
  MotionCommands(const PtuConfig& config, const PtuFacts& facts);

  // The unit's present state, as far as it is known.
  struct Now {
    PanTilt angles;
    PanTilt rate_rad_s;
    bool standing = false;  // the reported positions do not change
  };

  // The commands for a cycle at `time_s`; may be empty.
  PtuRequest next(const std::optional<mount::Goal>& goal, const Now& now, double time_s);
  // Commands that halt the unit. halt() is empty after a halt was sent, and repeats it if the unit
  // still moves after its braking time. halt_again() always contains the halt.
  PtuRequest halt(const Now& now, double time_s);
  PtuRequest halt_again(const Now& now, double time_s);

  // Call if the unit may not have received the last commands. The next cycle then contains all
  // commands again.
  void send_all_again();

  // The change of the axes' speeds by the last commands.
  const PanTilt& speed_change_rad_s() const { return change_; }

  const mount::Limits& limits() const { return limits_; }
  const std::optional<PtuLoweredSpeed>& lowered_speed() const { return lowered_; }

 private:
  struct Axis {
    PtuAxis name;
    PtuAxisFacts facts;
    std::int32_t min, max;                                  // the range limits_ in counts
    std::optional<std::int32_t> position = {}, speed = {};  // values last sent
  };
  static Axis axis(PtuAxis name, const PtuAxisFacts& facts, double min_rad, double max_rad);
  static void add_speed(Axis& axis, double speed_rad_s, PtuRequest& request);
  static void add_position(Axis& axis, double position_rad, PtuRequest& request);

  double change(double speed_rad_s, double way_rad, double rate_rad_s) const;

  void keep_running_on_short();

  ServoConfig servo_;
  std::optional<PtuLoweredSpeed> lowered_;
  mount::Limits limits_;
  Axis pan_, tilt_;
  double braking_s_ = 0.0;    // time that braking from the maximum speed takes
  double refreshed_s_ = 0.0;  // time at which all values were last sent
  std::optional<double> halted_s_;
  PanTilt change_;
};

}  // namespace ols::ptu
