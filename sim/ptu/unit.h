// A simulated FLIR PTU-D46-70 or PTU-E46-70 behind its serial line: bytes and time in, bytes and
// true angles out. Pure: sim/ptu/line.* puts it on a pty in real time, the lockstep simulation
// steps it. docs/ptu-conformance.md says which behaviour is documented, which was seen on real
// units, and which is assumed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "geometry/kinematic_chain.h"

namespace ols::sim {

enum class PtuModel { kD46, kE46 };

struct PtuUnitConfig {
  PtuModel model = PtuModel::kD46;
  std::string firmware;                // empty: 2.14.0, or 3.3.0 for the E46
  double resolution_arcsec = 11.5714;  // size of a count, both axes (D46-70, eighth step)
  int pan_min_counts = -49467, pan_max_counts = 49467;   // +-159 deg
  int tilt_min_counts = -14622, tilt_max_counts = 9644;  // -47..+31 deg
  int max_speed_counts_s = 18700;                        // about 60 deg/s
  int min_speed_counts_s = 31;
  int base_speed_counts_s = 57;
  int acceleration_counts_s2 = 2000;  // factory default; the master raises it
  int baud = 9600;  // at power-up; determines the duration of a byte; 0: bytes take no time
  double reply_delay_s = 0.001;  // from a command to its answer
  double reply_jitter_s = 0.0;   // added to the delay, uniform +-; the unit reads its counters at a
                                 // random instant of the delay
  double parameter_set_s = 0.0;  // duration of the commands PA, PB, PU, PL (seconds on real units)
  bool echo = true;              // factory default
  bool verbose = true;           // factory default
  bool home_at_power_up = true;
  bool homed_before = true;  // used without homing at power-up: whether it was homed earlier
  double home_speed_rad_s = 0.7;
};

class PtuUnit {
 public:
  PtuUnit(const PtuUnitConfig& config, std::uint64_t seed, double power_up_s);
  ~PtuUnit();

  // Takes bytes from the master; the transmission of the first begins at `time_s`. Time must not
  // decrease from call to call, whatever the method.
  void receive(std::string_view bytes, double time_s);

  // The bytes that have been sent completely by `time_s`. Each byte is returned once.
  std::string transmit(double time_s);

  // When transmit() will next return something, as far as known; nullopt: not before the unit
  // receives something.
  std::optional<double> next_output_s() const;

  // A power cycle: everything that was not saved is lost, including the position.
  void power_cycle(double time_s);
  // As if RE or RD had been sent.
  void home_at_power_up(bool homes);
  // As if EE had been sent.
  void switch_echo_on(double time_s);
  // The pan mechanism slips, unnoticed by the unit.
  void slip(double pan_rad, double time_s);

  // Sets the rate of the master's port. If it differs from the unit's rate, every byte becomes
  // noise. 0 (default): always equal to the unit's.
  void set_master_baud(int baud);

  // True shaft angles of the mechanism (pan left positive, tilt up positive), continuous. The
  // instant may be up to two seconds before the latest time given to any method.
  PanTilt angles_at(double time_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
