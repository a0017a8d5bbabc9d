// A PTU that is ready: polls its position, sends it where it shall go, notices what goes wrong on
// the line and mends what can be mended without a new start. Pure.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edge/ptu/driver_types.h"
#include "edge/ptu/motion_commands.h"
#include "edge/ptu/poll_cycle.h"
#include "edge/ptu/position_check.h"
#include "edge/ptu/start_sequence.h"
#include "edge/ptu/unit_model.h"

namespace ols {

class PtuSteadyState {
 public:
  // There must be no limits_conflict(). `counters` outlives this.
  PtuSteadyState(const PtuConfig& config, const PtuFacts& facts, double byte_s, double time_s,
                 PtuCounters& counters);

  // So many limit hits in one reply are those of homing, `!T!T!P!P*`, some of them lost.
  static constexpr int kHomingHits = 3;

  // What became of the unit, when it cannot go on like this.
  struct Trouble {
    enum class Kind {
      kNoReply,
      kNotItself,      // it answers, but not as it should: to be started again
      kBeganAnew,      // it was switched off and on
      kNotReferenced,  // it must be homed
    };
    Kind kind;
    std::string reason;
  };

  // Bytes to write now. Nothing moves in an emergency.
  std::string step(bool emergency, double time_s);
  // Where the unit shall go from now on; nothing: halt.
  void set_goal(const std::optional<ServoGoal>& goal) { goal_ = goal; }
  // `late_s`: the reply's bytes may have been there for so long before they were read.
  void take(const PtuReply& reply, double time_s, double late_s);
  void bytes_came(double time_s) { last_byte_s_ = time_s; }
  void line_was_garbled() { line_garbled_ = true; }
  void unit_began_anew();
  // What is under way is not waited for: its rest was thrown away.
  void abandon(double time_s);

  const std::optional<Trouble>& trouble() const { return trouble_; }
  std::vector<AngleSample> take_samples() { return std::exchange(samples_, {}); }
  const PtuFacts& facts() const { return facts_; }
  const PtuLimits& limits() const { return commands_.limits(); }
  const std::optional<PtuEnvironment>& environment() const { return environment_; }
  std::optional<double> last_good_s() const { return last_sample_s_; }
  bool standing() const { return check_.standing(); }
  std::string last_error() const { return error_; }
  const std::optional<PtuLoweredSpeed>& lowered_speed() const { return commands_.lowered_speed(); }

 private:
  PtuRequest commands_for(bool emergency, double time_s);
  PtuRequest questions_for(double time_s);
  std::string watch(double time_s);
  void finish(double time_s);
  void judge_refusals(const std::vector<std::string>& refusals, double time_s);
  void judge_modes(const PollCycle& done);
  PanTilt told_rad_s2(double time_s) const;
  void believe(const AngleSample& sample, double time_s);
  void give_up_cycle(double time_s, double quiet_s, std::string reason);
  void fail(Trouble::Kind kind, std::string reason);

  const PtuConfig& config_;
  const PtuFacts facts_;
  std::optional<ServoGoal> goal_;
  const double byte_s_;
  PtuCounters& counters_;
  MotionCommands commands_;
  PositionCheck check_;
  double latency_s_ = 0.0;  // running average of PollCycle::latency_s()
  AngleHistory history_;
  std::optional<PollCycle> cycle_;
  PanTilt told_;  // [rad/s] change of speed since the last sample
  std::vector<AngleSample> samples_;
  std::optional<PtuEnvironment> environment_;
  std::optional<Trouble> trouble_;
  std::string error_;

  double next_poll_s_;
  double quiet_s_ = 0.0;
  double last_byte_s_;
  std::optional<double> waiting_since_s_;  // for positions to be believed
  std::optional<double> last_sample_s_;
  double next_environment_s_;
  bool ask_environment_ = false;  // in the cycle that is under way
  bool line_garbled_ = false;     // in the cycle that is under way
  bool check_modes_ = false;      // the unit may have forgotten its modes
  bool checking_modes_ = false;   // in the cycle that is under way
  int checks_failed_ = 0;
  int bounds_refused_ = 0;
  double bounds_refused_s_ = 0.0;
};

}  // namespace ols
