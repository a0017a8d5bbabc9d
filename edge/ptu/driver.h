// The PTU driver as a pure state machine: takes bytes and time, returns bytes and angle samples.
// The serial port and the clock are outside (edge/ptu/ptu_thread.*); the lockstep simulation drives
// the same class with simulated time.
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
  PtuDriver(const PtuDriver&) = delete;  // its phases hold references to it
  PtuDriver& operator=(const PtuDriver&) = delete;

  // Takes bytes, and an instant [s, monotonic] by which all of them had arrived: the moment after
  // the read.
  void receive(std::string_view bytes, double time_s);

  // Advances time. Returns bytes to be written now (possibly none). Call at least every few
  // milliseconds.
  std::string step(double time_s);

  // Baud rate at which the bytes from step() are to be written. It changes while the driver
  // searches for the unit, and when the driver sets another rate.
  int line_baud() const;

  // Sets the goal; nullopt means halt. It takes effect with the next poll. It is dropped in an
  // emergency, and whenever the unit or its reference is lost.
  void set_goal(const std::optional<mount::Goal>& goal);

  // Halts the unit: sends halts until the unit is seen to stand still. Sends no other motion
  // command before clear_emergency(). Returns the bytes to write at once. Before writing them, the
  // caller must drop all bytes that are not on the line yet.
  std::string emergency_halt(double time_s);
  void clear_emergency() { emergency_ = false; }
  bool in_emergency() const { return emergency_; }

  // Halts the unit, waits until it stands still, and homes it: the command R sweeps the whole
  // travel. Ignored in an emergency. Abandoned if the unit does not answer.
  void home(double time_s);
  // Abandons homing. If the unit is already homing, a halt is sent, which some units ignore.
  void stop_homing(double time_s);
  // Sets whether PtuRehome::kWhenUnreferenced is in effect now. home() is always possible.
  void allow_rehoming(bool allowed) { rehoming_allowed_ = allowed; }
  // An operator confirms the reference, after homing the unit manually or checking it.
  void reference_ok();
  // Restores the doubt that an earlier process saved.
  void restore_doubt(const std::optional<mount::ReferenceDoubt>& doubt);

  // Starts the unit again, for example because the port was reopened.
  void restart(double time_s);

  // True once after the unit stopped answering; the caller should reopen the port.
  bool take_link_loss() { return std::exchange(link_lost_, false); }

  // The angle samples since the last call.
  std::vector<mount::AngleSample> take_samples();

  PtuState state() const;
  const PtuCounters& counters() const { return counters_; }
  const mount::Limits& limits() const;  // the limits in force; meaningful only once ready
  std::string firmware() const;         // the unit's answer to V; empty until ready
  std::string last_error() const;       // empty if there was no error
  std::optional<PtuEnvironment> environment() const;
  std::optional<double> last_good_s() const;  // time of the newest angle sample
  bool not_referenced() const;                // the unit must be homed
  bool homing() const;                        // from home() until the unit is ready again
  mount::Reference reference() const;
  std::optional<PtuDoubtCause> doubt() const { return reference_.cause(); }
  // The doubt for the next process, if this process ended now.
  std::optional<mount::ReferenceDoubt> doubt_to_persist() const;
  std::optional<PtuLoweredSpeed> lowered_speed() const;
  bool standing() const;  // the unit was seen to stand still

 private:
  // Each phase owns the data that exist only in that phase.
  struct NotStarted {};
  struct Homing {
    std::optional<double> ordered_s = {};  // time at which R was sent
  };
  struct Paused {  // after a fault, until the next start
    double since_s, until_s;
    bool answered;  // the unit has answered at this baud rate
    std::optional<int> listening_baud = {};
  };
  // The furthest phase that the driver has reached since the start.
  enum class Progress { kNone, kFaulted, kReady };

  // The longest time for which bytes may have waited before they were read: the longer one of the
  // last two pauses between calls.
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

  // Functions that change the phase. After a change, the object of the previous phase no longer
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
  int baud_;  // the rate that is being tried or in use
  PtuReplyParser parser_;
  PtuLimitHits hits_noted_;
  ReadDelay read_delay_;
  PtuCounters counters_;
  ReferenceWatch reference_;
  Progress progress_ = Progress::kNone;
  std::string error_;
  std::string urgent_;  // bytes to send before anything else
  bool emergency_ = false;
  bool link_lost_ = false;
  bool rehoming_allowed_ = true;
  double next_pause_s_ = kFirstPause_s;
  std::variant<NotStarted, PtuStarting, Homing, PtuSteadyState, Paused> phase_;

  static constexpr double kFirstPause_s = 0.25;  // after a fault; doubles with each further fault
};

}  // namespace ols::ptu
