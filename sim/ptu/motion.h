// The motion of the simulated PTU: positions, speeds and their limits, homing, and its output when
// it runs into a limit.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/ptu/axis.h"
#include "sim/ptu/settings.h"

namespace ols::sim {

// `!P`, `!T`: neither a reply nor the end of a line.
struct PtuToken {
  double time_s = 0.0;
  std::string text;
};

class PtuMotion {
 public:
  // `settings` must outlive it; homing applies the step mode, which changes the size of a count.
  PtuMotion(const PtuUnitConfig& config, PtuSettings& settings, double power_up_s);

  // Power-up: factory modes, no motion planned.
  void power_up();
  // Power failure: the unit stops, and loses its position.
  void power_off(double time_s);

  // The answer; nullopt: not a motion command.
  std::optional<std::string> execute(std::string_view command, bool verbose, double time_s);

  // Answers to commands of one axis [counts].
  std::string set_position(int axis, int target, double time_s);
  std::string set_speed(int axis, int speed, double time_s);
  std::string set_parameter(int axis, char what, int value, double time_s);

  void start(int axis, double target_counts, double time_s);
  void start_slaved(double time_s);

  // Homes, tilt first. Without homing, the counters start at the mechanism's position. Returns the
  // time at which it ends.
  double home(bool pan, bool tilt, double time_s);
  double home_together(double time_s);

  // Position in the unit's counts, from its assumed middle.
  double position(int axis, double time_s) const;
  double target(int axis) const;
  double velocity(int axis, double time_s) const;
  int least(int axis) const;  // limits of commands
  int greatest(int axis) const;
  int factory_least(int axis) const { return axes_[at(axis)].least / axes_[at(axis)].divisor; }
  int factory_greatest(int axis) const {
    return axes_[at(axis)].greatest / axes_[at(axis)].divisor;
  }

  int steps_a_count(int axis) const { return axes_[at(axis)].divisor; }
  bool homed(int axis) const { return axes_[at(axis)].homed; }
  double rest_s(int axis) const { return axes_[at(axis)].motion.rest_s(); }
  // The true position of the mechanism [steps]; the unit's counter may differ.
  double mechanism_steps(int axis, double time_s) const {
    return axes_[at(axis)].motion.position(time_s);
  }

  // The mechanism slips; the unit's counter does not notice.
  void slip(int axis, int slipped_steps, double time_s);

  // Limit hits up to this time; each is returned once.
  std::vector<PtuToken> take_tokens(double time_s);
  // When the next hit is due.
  std::optional<double> next_token_s() const;

  void forget(double before_s);

 private:
  enum class Limits { kFactory, kUser, kOff };
  // Positions of the mechanism are in steps of PtuUnitConfig's resolution, from the middle of its
  // travel. The unit's counts are `divisor` steps each, from its assumed middle.
  struct Axis {
    PtuAxis motion;
    int least, greatest;  // travel [steps]
    int divisor;          // steps per count
    double origin;        // origin of the counts [steps]
    bool homed;
    std::optional<double> slaved;  // target that waits for A or I [steps]
    std::optional<double> hit_s;   // when the motion hits its limit
  };

  bool e_series() const { return config_.model == PtuModel::kE46; }
  double counts(const Axis& axis, double steps) const;
  double steps(const Axis& axis, double counts) const;
  PtuAxis::Profile profile(int axis) const;
  void start_steps(int axis, double target_steps, double time_s);
  void stop(int axis, double time_s);
  void enter_velocity_mode(bool velocity, double time_s);
  double home_axis(int axis, double time_s);
  void take_step_mode(int axis);
  std::string refuse_speed(int axis, int fastest) const;
  std::optional<std::string> modes(std::string_view command, bool verbose, double time_s);
  std::optional<std::string> limit_modes(std::string_view command);
  std::optional<std::string> halts(std::string_view command, double time_s);

  PtuUnitConfig config_;
  PtuSettings& settings_;
  std::array<Axis, 2> axes_;
  bool velocity_mode_ = false;
  bool immediate_ = true;
  Limits limits_ = Limits::kFactory;
  std::vector<PtuToken> tokens_;  // from homing, in order of time
};

}  // namespace ols::sim
