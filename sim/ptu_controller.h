// The simulated PTU's command interpreter: one command in, one answer out, and the motion of both
// axes. Knows nothing of bytes on a line; ptu_unit.cpp gives it commands in time.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/ptu_axis.h"
#include "sim/ptu_unit.h"

namespace ols::sim {

struct PtuAnswer {
  std::string text;      // with its `*` or `!`, without the line's end; empty: it stays silent
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

  // The power comes: settings as saved, homing if chosen. What the unit says when that is over;
  // what it says before is banner().
  PtuAnswer power_up(double time_s);
  // It was gone for a moment, and with it what the unit knew of where it stands.
  PtuAnswer power_cycle(double time_s);
  std::string banner() const;
  void home_at_power_up(bool homes) { homes_ = {homes, homes}; }

  PtuAnswer execute(std::string_view command, double time_s);

  // A byte has arrived, whichever: it ends a scan that began before.
  void interrupt(double time_s);
  bool scanning() const { return axes_[0].sweep || axes_[1].sweep; }

  // What the unit does by itself up to an instant: the legs of a scan.
  void advance(double time_s);

  // Limit hits up to an instant that were not handed out before, and when the next one is due.
  std::vector<PtuToken> take_tokens(double time_s);
  std::optional<double> next_token_s() const;

  bool echo() const { return selected_ && settings_.echo; }
  bool talks() const { return selected_ && settings_.feedback != Feedback::kOff; }
  int baud() const { return baud_; }

  // Of the mechanism, whatever the unit thinks [counts of PtuUnitConfig's resolution].
  double position_counts(int axis, double time_s) const {
    return axes_[at(axis)].motion.position(time_s);
  }

  // The mechanism gives way; the unit's counter does not notice.
  void slip(int axis, int counts, double time_s);
  void switch_echo_on() { settings_.echo = true; }

  void forget(double before_s);

 private:
  enum class Feedback { kVerbose, kTerse, kOff };
  enum class Limits { kFactory, kUser, kOff };
  struct AxisSettings {  // in the unit's counts
    int speed, acceleration, base_speed, upper_speed, lower_speed;
    char hold_power, move_power, step_mode;
    int user_least, user_greatest;
    int home_speed;  // of RPS, RTS [counts/s]
  };
  struct Settings {  // what DS keeps
    bool echo;
    Feedback feedback;
    std::array<AxisSettings, 2> axes;
    int unit_id;
    bool scan_at_power_up;
    bool encoder_correction;
  };
  struct Sweep {
    double first, second;  // between them [steps]
    bool to_second;
    double begun_s;
  };
  // Positions of the mechanism are in the steps of PtuUnitConfig's resolution, from the middle of
  // its travel; the unit's counts are `divisor` of them, from where it believes the middle.
  struct Axis {
    PtuAxis motion;
    std::string name;
    int least, greatest;  // travel [steps]
    int divisor;          // steps a count
    double origin;        // of the counts [steps]
    bool homed;
    std::optional<double> slaved;  // target that waits for A or I [steps]
    std::optional<double> hit_s;   // the motion runs into its limit then
    std::optional<Sweep> sweep;    // scanning
  };
  using Handler = std::optional<std::string> (PtuController::*)(std::string_view, double);

  static std::size_t at(int axis) { return static_cast<std::size_t>(axis); }
  bool e_series() const { return config_.model == PtuModel::kE46; }
  bool verbose() const { return settings_.feedback == Feedback::kVerbose; }
  std::string firmware() const;
  bool has_presets() const;

  PtuAnswer dispatch(const std::string& command, double time_s);
  std::optional<PtuAnswer> blocking(std::string_view command, double time_s);

  // ptu_motion.cpp
  double counts(const Axis& axis, double steps) const;
  double steps(const Axis& axis, double counts) const;
  int least(int axis) const;  // that commands are held to [counts]
  int greatest(int axis) const;
  PtuAxis::Profile profile(int axis) const;
  std::string set_position(int axis, int target, double time_s);
  std::string set_speed(int axis, int speed, double time_s);
  std::string set_parameter(int axis, char what, int value, double time_s);
  void start(int axis, double target_steps, double time_s);
  void start_slaved(double time_s);
  void stop(int axis, double time_s);
  void enter_velocity_mode(bool velocity, double time_s);

  // ptu_homing.cpp
  double home(bool pan, bool tilt, double time_s);
  double home_together(double time_s);
  double home_axis(int axis, double time_s);
  void take_step_mode(int axis);
  std::optional<std::string> scan(std::string_view command, double time_s);
  std::string start_scan(const std::vector<int>& ends, double time_s);
  std::optional<std::string> preset(std::string_view command, double time_s);

  // ptu_answers.cpp
  std::string axis_command(int axis, std::string_view command, double time_s);
  std::string query(int axis, char what, double time_s) const;
  std::string number(int axis, char what, double time_s) const;
  std::string refuse_speed(int axis, int fastest) const;
  std::string version() const;
  std::optional<std::string> information(std::string_view command, double time_s);

  // ptu_settings.cpp
  std::optional<std::string> modes(std::string_view command, double time_s);
  std::optional<std::string> toggles(std::string_view command, double time_s);
  std::optional<std::string> limit_modes(std::string_view command, double time_s);
  std::optional<std::string> halts(std::string_view command, double time_s);
  std::optional<std::string> homing_choice(std::string_view command, double time_s);
  std::optional<std::string> keeping(std::string_view command, double time_s);
  std::optional<std::string> host_port(std::string_view command, double time_s);
  std::optional<std::string> unit_id(std::string_view command, double time_s);
  std::optional<std::string> e_series_only(std::string_view command, double time_s);
  std::optional<std::string> step_mode(std::string_view command);
  std::optional<std::string> move_both(std::string_view command, double time_s);
  std::string power(int axis, std::string_view what);
  std::string homing_speed(int axis, std::string_view wanted);
  std::string user_limit(int axis, std::string_view what);
  Settings factory_settings() const;

  PtuUnitConfig config_;
  Settings settings_, saved_;
  std::array<Axis, 2> axes_;
  std::array<bool, 2> homes_;  // which axes home at power-up; kept at once
  std::map<int, std::pair<int, int>> presets_;
  std::vector<int> scan_ends_;
  bool velocity_mode_ = false;
  bool immediate_ = true;
  Limits limits_ = Limits::kFactory;
  bool selected_ = true;  // of the units on one line, it is the one that is talked to
  int baud_, baud_at_power_up_;
  std::vector<PtuToken> tokens_;  // of a homing run, in order of time
};

// What a unit says to what it does not understand (transcripts of real units).
constexpr const char* kIllegalCommand = "! Illegal Command Entered";
constexpr const char* kIllegalArgument = "! Illegal argument";
constexpr const char* kAxisError = "! Axis Error";

// The answer to a query.
std::string star(std::string_view text);

// All of the text, or nothing.
std::optional<int> whole_number(std::string_view text);
// `1,-2,3`.
std::optional<std::vector<int>> whole_numbers(std::string_view text);

}  // namespace ols::sim
