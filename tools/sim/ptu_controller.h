// The simulated PTU's command interpreter: one command in, one answer out, and the motion of both
// axes. Knows nothing of bytes on a line; ptu_unit.cpp gives it commands in time.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/sim/ptu_axis.h"
#include "tools/sim/ptu_unit.h"

namespace ols::sim {

struct PtuAnswer {
  std::string text;      // with its `*` or `!`, without the line's end
  double ready_s = 0.0;  // not before: commands that wait for the motion
};

// `!P`, `!T`: not a reply, no line's end.
struct PtuToken {
  double time_s = 0.0;
  std::string text;
};

class PtuController {
 public:
  PtuController(const PtuUnitConfig& config, double power_up_s);

  // What the unit says when it is switched on, and when its homing is over.
  PtuAnswer power_up(double time_s);

  PtuAnswer execute(std::string_view command, double time_s);

  // Limit hits up to an instant that were not handed out before, and when the next one is due.
  std::vector<PtuToken> take_tokens(double time_s);
  std::optional<double> next_token_s() const;

  bool echo() const { return settings_.echo; }
  int baud() const { return baud_; }
  double position_counts(int axis, double time_s) const {
    return axes_[at(axis)].motion.position(time_s);
  }
  void forget(double before_s);

 private:
  struct AxisSettings {
    int speed, acceleration, base_speed, upper_speed, lower_speed;
    char hold_power, move_power;
  };
  struct Settings {  // what DS keeps
    bool echo, verbose;
    std::array<AxisSettings, 2> axes;
  };
  struct Axis {
    PtuAxis motion;
    std::string name;
    int least, greatest;          // soft limits [counts]
    std::optional<int> slaved;    // target that waits for A or I
    std::optional<double> hit_s;  // the motion runs into its limit then
  };

  static std::size_t at(int axis) { return static_cast<std::size_t>(axis); }
  PtuAxis::Profile profile(int axis) const;
  std::string query(int axis, char what, double time_s) const;
  std::string set(int axis, char what, int value, double time_s);
  std::string set_position(int axis, int target, double time_s);
  std::string set_speed(int axis, int speed, double time_s);
  std::string set_parameter(int axis, char what, int value, double time_s);
  std::string power(int axis, std::string_view what);
  std::optional<std::string> mode(std::string_view command, double time_s);
  std::optional<std::string> toggles(std::string_view command);
  std::optional<std::string> halts(std::string_view command, double time_s);
  std::string change_baud(std::string_view command);
  std::string defaults(std::string_view command);
  void start(int axis, int target, double time_s);
  void start_slaved(double time_s);
  double home(double time_s);

  PtuUnitConfig config_;
  Settings settings_, saved_;
  std::array<Axis, 2> axes_;
  bool velocity_mode_ = false;
  bool immediate_ = true;
  bool limits_ = true;
  int baud_;
  std::vector<PtuToken> tokens_;  // of a homing run, in order of time
};

}  // namespace ols::sim
