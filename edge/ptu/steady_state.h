// The phase of PtuDriver in which a unit is ready. Polls the unit's position, moves it to its goal,
// detects faults, and corrects those that need no new start sequence. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/ptu/angle_intake.h"
#include "edge/ptu/driver_types.h"
#include "edge/ptu/mode_check.h"
#include "edge/ptu/motion_commands.h"
#include "edge/ptu/polling.h"
#include "edge/ptu/start_sequence.h"
#include "edge/ptu/unit_model.h"

namespace ols::ptu {

class PtuSteadyState {
 public:
  // There must be no limits_conflict(). `config` and `counters` must outlive this object.
  PtuSteadyState(const PtuConfig& config, const PtuFacts& facts, double byte_s, double time_s,
                 PtuCounters& counters);

  // If one reply contains at least this number of limit hits, the unit has homed. A homing causes
  // four (`!T!T!P!P*`), but one of them may be lost.
  static constexpr int kHomingHits = 3;

  // Why the unit must be started again.
  struct Trouble {
    enum class Kind {
      kNoReply,
      kNotItself,      // the unit answers, but not as expected
      kRestarted,      // the unit has lost power, or has homed
      kNotReferenced,  // the unit must be homed
    };
    Kind kind;
    std::string reason;
  };

  // Returns the bytes to write now. In an emergency, they contain no motion command except halts.
  std::string step(bool emergency, double time_s);
  // Sets the goal; nullopt means halt.
  void set_goal(const std::optional<mount::Goal>& goal) { goal_ = goal; }
  // Takes a reply. `late_s`: the longest time for which its bytes may have waited before they were
  // read.
  void take(const PtuReply& reply, double time_s, double late_s);
  void bytes_came(double time_s) { polling_.bytes_came(time_s); }
  void line_was_garbled() { polling_.line_was_garbled(); }
  void unit_restarted();
  // Abandons the current cycle, because other bytes are written.
  void abandon(double time_s);

  const std::optional<Trouble>& trouble() const { return trouble_; }
  std::vector<mount::AngleSample> take_samples() { return angles_.take_samples(); }
  const PtuFacts& facts() const { return facts_; }
  const mount::Limits& limits() const { return commands_.limits(); }
  const std::optional<PtuEnvironment>& environment() const { return environment_.newest; }
  std::optional<double> last_good_s() const { return angles_.last_good_s(); }
  bool standing() const { return angles_.standing(); }
  // The last error on the line, if there were ten disturbances within a minute; otherwise empty.
  std::string last_error() const {
    return corrected_.times >= kManyCorrected ? error_ : std::string();
  }
  const std::optional<PtuLoweredSpeed>& lowered_speed() const { return commands_.lowered_speed(); }

 private:
  struct Environment {
    double next_s;
    bool asked = false;  // the current cycle contains a query
    std::optional<PtuEnvironment> newest = {};
  };
  static constexpr int kManyCorrected = 10;  // disturbances within kCorrected_s
  static constexpr double kCorrected_s = 60.0;
  static constexpr double kDisturbed_s = 1.0;
  struct Corrected {
    int times = 0;
    double since_s = 0.0;
    double last_s = -1e9;  // beginning of the newest disturbance
  };
  struct BoundsRefused {
    int times = 0;
    double last_s = 0.0;
  };
  PtuRequest commands_for(bool emergency, double time_s);
  PtuRequest questions_for(double time_s);
  void give_up_waiting(double time_s);
  void watch(double time_s);
  void finish(const PollCycle& done, double time_s);
  void take_angles(const PollCycle& done, double time_s);
  void judge_refusals(const std::vector<std::string>& refusals, double time_s);
  void judge_modes(const PollCycle& done);
  void send_all_again(std::string because, double time_s);
  void note_corrected(std::string what, double time_s);
  void fail(Trouble::Kind kind, std::string reason);

  const PtuConfig& config_;
  const PtuFacts facts_;
  PtuCounters& counters_;
  std::optional<mount::Goal> goal_;
  MotionCommands commands_;
  Polling polling_;
  AngleIntake angles_;
  ModeCheck modes_;
  Environment environment_;
  BoundsRefused bounds_refused_;
  Corrected corrected_;
  std::optional<double> waiting_since_s_;  // time since which plausible positions are missing
  std::optional<Trouble> trouble_;
  std::string error_;
};

}  // namespace ols::ptu
