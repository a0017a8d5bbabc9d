// Turns goals into the commands of a cycle: the servo's output in counts (if it has changed), and
// halts. Pure.
#pragma once

#include <optional>
#include <string>

#include "edge/ptu/codec.h"
#include "edge/ptu/driver_types.h"
#include "edge/ptu/start_sequence.h"

namespace ols::ptu {

// Says which axis has no position within both the configured limits and the unit's own, and why;
// empty if both axes have one.
std::string limits_conflict(const mount::Limits& configured, const PtuFacts& facts);

class MotionCommands {
 public:
  // Uses the narrower bounds of the configuration and the unit. Call it only if there is no
  // limits_conflict().
  MotionCommands(const PtuConfig& config, const PtuFacts& facts);

  // The unit's angles and rates, as far as known.
  struct Now {
    PanTilt angles;
    PanTilt rate_rad_s;
    bool standing = false;  // the unit was seen to stand still
  };

  // The commands to send at `time_s`.
  PtuRequest next(const std::optional<mount::Goal>& goal, const Now& now, double time_s);
  // Commands that halt the unit; they are repeated until it stands still.
  PtuRequest halt(const Now& now, double time_s);
  PtuRequest halt_again(const Now& now, double time_s);

  // Call if the unit may not have received the last commands.
  void send_all_again();

  // The change of the axes' speeds that the last commands cause.
  const PanTilt& speed_change_rad_s() const { return change_; }

  const mount::Limits& limits() const { return limits_; }
  const std::optional<PtuLoweredSpeed>& lowered_speed() const { return lowered_; }

 private:
  struct Axis {
    PtuAxis name;
    PtuAxisFacts facts;
    std::int32_t min, max;                                  // within limits_ [counts]
    std::optional<std::int32_t> position = {}, speed = {};  // as last sent
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
  double braking_s_ = 0.0;    // time for braking from full speed
  double refreshed_s_ = 0.0;  // time at which everything was last sent
  std::optional<double> halted_s_;
  PanTilt change_;
};

}  // namespace ols::ptu
