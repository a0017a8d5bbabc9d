// The simulated PTU's command interpreter: one command in, one answer out, and the motion of both
// axes. It knows nothing of the serial line; sim/ptu/unit.cpp passes it each command as soon as
// the command is complete.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/ptu/answers.h"
#include "sim/ptu/motion.h"
#include "sim/ptu/presets.h"
#include "sim/ptu/scan.h"
#include "sim/ptu/setup.h"

namespace ols::sim {

struct PtuAnswer {
  std::string text;      // with its `*` or `!`, without the line's end; empty: no answer
  double ready_s = 0.0;  // earliest time of the answer; some commands wait for the end of a motion
};

class PtuController {
 public:
  PtuController(const PtuUnitConfig& config, double power_up_s);
  PtuController(const PtuController&) = delete;
  PtuController& operator=(const PtuController&) = delete;

  // Powers up with the saved settings; homes if selected. Returns the output at the end of
  // power-up; banner() is the output at the beginning.
  PtuAnswer power_up(double time_s);
  // A short power failure, in which the unit loses its position.
  PtuAnswer power_cycle(double time_s);
  std::string banner() const { return answers_.banner(); }
  void home_at_power_up(bool homes) { setup_.home_at_power_up(homes); }

  PtuAnswer execute(std::string_view command, double time_s);

  // A byte has arrived: it ends a scan that began earlier.
  void interrupt(double time_s) { scan_.interrupt(time_s); }
  bool scanning() const { return scan_.running(); }

  // Plans the legs of a scan up to an instant.
  void advance(double time_s) { scan_.advance(time_s); }

  // The outputs for limit hits up to this time, each returned once. next_token_s(): when the next
  // one is due.
  std::vector<PtuToken> take_tokens(double time_s);
  std::optional<double> next_token_s() const { return motion_.next_token_s(); }

  bool echo() const { return setup_.selected() && setup_.settings().echo; }
  bool talks() const {
    return setup_.selected() && setup_.settings().feedback != PtuFeedback::kOff;
  }
  int baud() const { return setup_.baud(); }

  // The true position of the mechanism [counts of PtuUnitConfig's resolution]; the unit's own
  // counter may differ.
  double position_counts(int axis, double time_s) const {
    return motion_.mechanism_steps(axis, time_s);
  }

  // The mechanism slips; the unit's counter does not change.
  void slip(int axis, int counts, double time_s) { motion_.slip(axis, counts, time_s); }
  void switch_echo_on() { setup_.switch_echo_on(); }

  void forget(double before_s) { motion_.forget(before_s); }

 private:
  bool e_series() const { return config_.model == PtuModel::kE46; }
  PtuAnswer dispatch(const std::string& command, double time_s);
  std::optional<std::string> at_once(std::string_view command, double time_s);
  std::optional<PtuAnswer> blocking(std::string_view command, double time_s);
  double home(bool pan, bool tilt, double time_s);
  std::string axis_command(int axis, std::string_view command, double time_s);
  std::string set_axis(int axis, char what, int value, double time_s);
  std::optional<std::string> clock(std::string_view command, double time_s) const;
  std::optional<std::string> both_axes(std::string_view command, double time_s);
  std::string report_both(bool with_time, double time_s) const;

  PtuUnitConfig config_;
  PtuSetup setup_;
  PtuMotion motion_;
  PtuScan scan_;
  PtuPresets presets_;
  PtuAnswers answers_;
};

}  // namespace ols::sim
