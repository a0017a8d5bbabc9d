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

// `!P` or `!T`, the unit's output at a limit hit. It is not a reply to a command, and no line end
// follows it.
struct PtuToken {
  double time_s = 0.0;
  std::string text;
};

class PtuMotion {
 public:
  // `settings` must outlive this object; homing applies the step mode, which changes the size of a
  // count.
  PtuMotion(const PtuUnitConfig& config, PtuSettings& settings, double power_up_s);

  // Powers up: selects the factory's modes, without any planned motion.
  void power_up();
  // The power fails: the unit stops and loses its position.
  void power_off(double time_s);

  // Executes a motion command and returns the answer; nullopt: the command is not one.
  std::optional<std::string> execute(std::string_view command, bool verbose, double time_s);

  // Execute commands to one axis, in counts, and return the answer.
  std::string set_position(int axis, int target, double time_s);
  std::string set_speed(int axis, int speed, double time_s);
  std::string set_parameter(int axis, char what, int value, double time_s);

  void start(int axis, double target_counts, double time_s);
  void start_slaved(double time_s);

  // Homes the selected axes, tilt first. Returns the time at which homing ends. The counts of an
  // axis that is not homed do not change: after a power failure, they begin with 0 where the
  // mechanism came to rest.
  double home(bool pan, bool tilt, double time_s);
  double home_together(double time_s);

  // The position in the unit's counts. Their zero is where the unit assumes the middle of the
  // travel.
  double position(int axis, double time_s) const;
  double target(int axis) const;
  double velocity(int axis, double time_s) const;
  int least(int axis) const;  // limits of commanded positions, in counts
  int greatest(int axis) const;
  int factory_least(int axis) const { return axes_[at(axis)].least / axes_[at(axis)].divisor; }
  int factory_greatest(int axis) const {
    return axes_[at(axis)].greatest / axes_[at(axis)].divisor;
  }

  int steps_a_count(int axis) const { return axes_[at(axis)].divisor; }
  bool homed(int axis) const { return axes_[at(axis)].homed; }
  double rest_s(int axis) const { return axes_[at(axis)].motion.rest_s(); }
  // The true position of the mechanism [steps]; the unit's own counter may differ.
  double mechanism_steps(int axis, double time_s) const {
    return axes_[at(axis)].motion.position(time_s);
  }

  // The mechanism slips; the unit's counter does not change.
  void slip(int axis, int slipped_steps, double time_s);

  // The outputs for limit hits up to this time, each returned once.
  std::vector<PtuToken> take_tokens(double time_s);
  // When the next output is due.
  std::optional<double> next_token_s() const;

  void forget(double before_s);

 private:
  enum class Limits { kFactory, kUser, kOff };
  // Positions of the mechanism are in steps of PtuUnitConfig's resolution, from the middle of the
  // travel. A count of the unit is `divisor` steps; counts begin at the middle that the unit
  // assumes.
  struct Axis {
    PtuAxis motion;
    int least, greatest;  // travel [steps]
    int divisor;          // steps per count
    double origin;        // origin of the counts [steps]
    bool homed;
    std::optional<double> slaved;  // target [steps] that waits for the command A or I
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
