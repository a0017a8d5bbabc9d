// The PTU driver as a pure state machine: bytes and time in, bytes and angle samples out. The
// serial port and the clock are at the edge (edge/ptu/ptu_thread.*); the lockstep simulation drives
// the same class from simulated time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/ptu/angle_history.h"
#include "edge/ptu/reference_watch.h"
#include "edge/ptu/servo.h"
#include "edge/ptu/unit_model.h"

namespace ols {

// What happens when a unit does not know where it is, or may be wrong about it. Homing sweeps the
// whole travel, whatever stands there, so that only the configuration or a person can allow it.
enum class PtuRehome {
  kNever,             // the unit is a fault until somebody homed it or vouched for it
  kWhenUnreferenced,  // R, once after each loss
};

// What the unit's angles are worth.
enum class PtuReference {
  kUnknown,  // no unit that could be driven
  kMissing,  // the unit says itself that it must be homed, or it is homing
  kDoubted,  // PtuDoubt: no samples come, no goals are heeded, until it was homed or vouched for
  kTrusted,
};

// What whoever ends now must leave to the next process about the unit's counts: nothing; that they
// are in doubt; that a homing was broken off, or is under way; that the unit does not know its
// gears and must be homed, whatever a person says; both of these. Only a homing, or a person where
// one may vouch, makes it less.
enum class PtuLegacy { kNone, kDoubt, kBrokenHoming, kGearsLost, kBrokenHomingGearsLost };

// A unit that accelerates less than configured, and is driven no faster than it can stop in time.
struct PtuLoweredSpeed {
  double acceleration_rad_s2, speed_rad_s;
};

struct PtuConfig {
  std::string device;              // serial device, for example /dev/ttyUSB0
  int baud = 38400;                // to be used
  int line_baud = 9600;            // at which a unit may answer that was just switched on
  double poll_interval_s = 0.025;  // one request for both positions and the servo's commands
  double reply_timeout_s =
      0.5;  // nothing to be believed for so long: the link is down, begin again
  double acceleration_rad_s2 = 1.0;     // set at start
  double environment_interval_s = 5.0;  // supply voltage and temperatures; 0: never
  double supply_min_V = 11.5;           // an alarm below
  PtuRehome rehome = PtuRehome::kNever;
  // The unit's own setting, as it leaves the factory: one that was switched on just before it is
  // first spoken to answers when it has homed, and is believed.
  bool homes_at_power_up = true;
  bool home_despite_keep_out = false;                  // on command
  char step_mode = 0, hold_power = 0, move_power = 0;  // PtuStartOptions
  PtuLimits limits;                                    // narrowed by what the unit reports
  AngleHistory::Config history;
  ServoConfig servo;
};

enum class PtuState { kStarting, kReady, kFault };

struct PtuCounters {  // only go up
  std::uint64_t requests = 0, replies = 0, timeouts = 0, errors = 0, garbled = 0, restarts = 0;
  std::uint64_t limit_hits = 0;
  std::uint64_t refused_positions = 0;  // pairs that contradicted each other or the motion
  std::uint64_t echoes = 0;             // echo or verbose replies that came on in mid-run
  std::uint64_t power_cycles = 0;       // noticed in mid-run
  std::uint64_t homings = 0;            // sent from here
  std::uint64_t emergencies = 0;
};

class PtuDriver {
 public:
  explicit PtuDriver(const PtuConfig& config);
  ~PtuDriver();
  PtuDriver(PtuDriver&&) noexcept;

  // Bytes that arrived, with an instant [s, monotonic] by which all of them were there: the moment
  // after the read.
  void receive(std::string_view bytes, double time_s);

  // Advances time: returns bytes to write now (may be empty). Call at least every few milliseconds.
  std::string step(double time_s);

  // Rate of the line, at which step()'s bytes are to be written. Changes while the unit is searched
  // for and when it was told another one.
  int line_baud() const;

  // Where the unit shall go from now on; nothing: halt. Takes effect with the next poll. Forgotten
  // in an emergency and whenever the unit or its reference is lost.
  void set_goal(const std::optional<ServoGoal>& goal);

  // From now on nothing moves: halts go out, again and again until the unit was seen to stand, and
  // no other command of motion until clear_emergency(). Returns what to write at once, whatever is
  // under way; bytes that are not on the line yet are better thrown away before.
  std::string emergency_halt(double time_s);
  void clear_emergency();
  bool in_emergency() const;

  // Halts the unit, waits until it stands and has it home: R sweeps the whole travel. Not in an
  // emergency, and given up when the unit does not answer.
  void home(double time_s);
  // Sends a halt to a unit that homes, which it may heed or not, and gives up what was wanted;
  // nothing while it does not home.
  void stop_homing(double time_s);
  // Whether PtuRehome::kWhenUnreferenced is heeded now; it is at first. home() always is.
  void allow_rehoming(bool allowed);
  // A person vouches for the reference: it was homed by hand, or checked.
  void reference_ok();
  // What the process before this one left.
  void inherit(PtuLegacy legacy);

  // Begins again from power-up, for example when the port was reopened.
  void restart(double time_s);

  // True once after the unit had stopped answering: the port is better opened anew.
  bool take_link_loss();

  // Angle samples since the last call.
  std::vector<AngleSample> take_samples();

  PtuState state() const;
  const PtuCounters& counters() const;
  const PtuLimits& limits() const;    // those in force; meaningful once ready
  double pan_resolution_rad() const;  // [rad] per count as queried
  double tilt_resolution_rad() const;
  std::string firmware() const;    // answer to V; empty until ready
  std::string last_error() const;  // empty when there was none
  std::optional<PtuEnvironment> environment() const;
  std::optional<double> last_good_s() const;  // when the last angle was taken in
  bool not_referenced() const;                // the unit says that it does not know where it is
  bool homing() const;                        // since home() or by itself, until it is ready
  PtuReference reference() const;
  PtuDoubt doubt() const;
  PtuLegacy legacy() const;
  std::optional<PtuLoweredSpeed> lowered_speed() const;
  bool standing() const;  // seen not to move

  // Bytes that stop the unit at once, whatever the driver was doing: for the end of the process.
  static std::string halt_request();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
