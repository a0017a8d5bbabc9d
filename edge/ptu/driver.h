// The PTU driver as a pure state machine: it takes bytes and the time, and returns bytes and angle
// samples. Serial port and clock are elsewhere (edge/ptu/ptu_thread.*), so that the lockstep
// simulation can run the same class in simulated time.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "edge/ptu/driver_types.h"
#include "edge/ptu/reference_watch.h"
#include "edge/ptu/starting.h"
#include "edge/ptu/steady_state.h"
#include "edge/ptu/unit_model.h"

namespace ols::ptu {

class PtuDriver {
 public:
  explicit PtuDriver(const PtuConfig& config) : config_(config), baud_(config.baud) {}
  PtuDriver(const PtuDriver&) = delete;  // its phases contain references to its members
  PtuDriver& operator=(const PtuDriver&) = delete;

  // Takes received bytes. `time_s` [s, monotonic]: a time by which all of them had arrived, such as
  // the time just after reading them.
  void receive(std::string_view bytes, double time_s);

  // Returns the bytes to write now, possibly none. Call at least every few milliseconds.
  std::string step(double time_s);

  // The baud rate at which the bytes from step() must be written. It changes while the driver
  // searches for the unit, and when the driver sets another rate in the unit.
  int line_baud() const;

  // Sets the goal; nullopt means halt. The goal takes effect in the next poll cycle. It is dropped
  // in an emergency, and when the unit or its reference is lost.
  void set_goal(const std::optional<mount::Goal>& goal);

  // Halts the unit: halts are repeated until the reported positions no longer change. No other
  // motion command is sent before clear_emergency(). Returns the bytes to write at once; the caller
  // must first drop all earlier bytes that have not been sent yet.
  std::string emergency_halt(double time_s);
  void clear_emergency() { emergency_ = false; }
  bool in_emergency() const { return emergency_; }

  // Halts the unit, waits until it stands still, and homes it: on the command R, the unit sweeps
  // its whole travel. Ignored in an emergency. Homing is abandoned if the unit does not answer.
  void home(double time_s);
  // Abandons homing. If the unit is already homing, the driver sends a halt, which some units
  // ignore.
  void stop_homing(double time_s);
  // Sets whether the driver may home the unit by itself, if the configuration has
  // PtuRehome::kWhenUnreferenced. home() does not depend on this.
  void allow_rehoming(bool allowed) { rehoming_allowed_ = allowed; }
  // An operator confirms the reference, after having checked it or homed the unit manually.
  void reference_ok();
  // Restores the doubt about the reference that an earlier process has saved.
  void restore_doubt(const std::optional<mount::ReferenceDoubt>& doubt);

  // Starts the unit again from the beginning, for example after the port was reopened.
  void restart(double time_s);

  // Returns true, once, after the unit has stopped answering. The caller should then reopen the
  // port.
  bool take_link_loss() { return std::exchange(link_lost_, false); }

  // The angle samples since the last call; none unless the reference is trusted.
  std::vector<mount::AngleSample> take_samples();

  PtuState state() const;
  const PtuCounters& counters() const { return counters_; }
  // The limits in force; once the unit is ready, the narrower of the configured and the unit's own.
  const mount::Limits& limits() const;
  std::string firmware() const;    // the unit's answer to V; empty until ready
  std::string last_error() const;  // empty if there was no error
  std::optional<PtuEnvironment> environment() const;
  std::optional<double> last_good_s() const;  // time at which the newest accepted positions arrived
  bool not_referenced() const;                // the unit must be homed
  bool homing() const;                        // from home() until the unit is ready again
  mount::Reference reference() const;
  std::optional<PtuDoubtCause> doubt() const { return reference_.cause(); }
  // The doubt about the reference to save for the next process; nullopt if there is none.
  std::optional<mount::ReferenceDoubt> doubt_to_persist() const;
  std::optional<PtuLoweredSpeed> lowered_speed() const;
  bool standing() const;  // the reported positions do not change

 private:
  // The phases of the driver. Each contains the data that exist only in that phase.
  struct NotStarted {};
  struct Homing {
    std::optional<double> ordered_s = {};  // time at which R (home) was sent
  };
  struct Paused {  // after a fault, until the next start
    double since_s, until_s;
    bool answered;  // the unit has answered at this baud rate
    std::optional<int> listening_baud = {};
  };
  // The furthest state that the driver has reached since its construction.
  enum class Progress { kNone, kFaulted, kReady };

  // The longest time for which received bytes may have waited before they were read: the longer one
  // of the last two intervals between two calls of receive().
  struct ReadDelay {
    void note_call(double time_s) {
      const double pause_s = std::max(0.0, time_s - called_s);
      longest_s = std::max(pause_s, std::exchange(last_pause_s, pause_s));
      called_s = time_s;
    }
    double called_s = 0.0, last_pause_s = 0.0, longest_s = 0.0;
  };

  std::string step(NotStarted& phase, double time_s);
  std::string step(PtuStarting& phase, double time_s);
  std::string step(Homing& phase, double time_s);
  std::string step(PtuSteadyState& phase, double time_s);
  std::string step(Paused& phase, double time_s);
  void take(PtuStarting& phase, const PtuReply& reply, double time_s);
  void take(Homing& phase, const PtuReply& reply, double time_s);
  void take(const PtuReply& reply, double time_s);

  // The following functions change the phase. The object of the previous phase then no longer
  // exists.
  void start(PtuStarting::Purpose purpose, double time_s);
  void fault(double time_s, std::string reason);
  bool home_if(bool wanted);
  void become_ready(const PtuFacts& facts, PtuStarting::Purpose purpose, double time_s);
  void give_up_homing(double time_s);
  void heed_trouble(double time_s);

  void leave_homing();
  void drop_line(double time_s);
  void change_rate(double time_s);
  void note_limit_hits(const std::vector<PtuReply>& replies, double time_s);
  void note_power_cycle();
  bool may_rehome() const;
  double byte_s() const;
  PtuSteadyState* ready() { return std::get_if<PtuSteadyState>(&phase_); }
  const PtuSteadyState* ready() const { return std::get_if<PtuSteadyState>(&phase_); }

  const PtuConfig config_;
  int baud_;  // the baud rate that is tried or in use
  PtuReplyParser parser_;
  PtuLimitHits hits_noted_;
  ReadDelay read_delay_;
  PtuCounters counters_;
  ReferenceWatch reference_;
  Progress progress_ = Progress::kNone;
  std::string error_;
  std::string urgent_;  // bytes to send before all others
  bool emergency_ = false;
  bool link_lost_ = false;
  bool rehoming_allowed_ = true;
  double next_pause_s_ = kFirstPause_s;
  std::variant<NotStarted, PtuStarting, Homing, PtuSteadyState, Paused> phase_;

  static constexpr double kFirstPause_s = 0.25;  // after a fault; doubles with each further fault
};

}  // namespace ols::ptu
