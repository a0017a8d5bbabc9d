// A simulated FLIR PTU-D46-70 or PTU-E46-70 behind its serial line: bytes and time in, bytes and
// true angles out. Pure; sim/ptu_line.* puts it on a pty in real time, the lockstep
// simulation steps it. What of it is documented, seen on real units or only assumed:
// docs/ptu-conformance.md.
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
  std::string firmware;                // empty: 2.14.0, or 3.3.0 of the E46
  double resolution_arcsec = 11.5714;  // per count, both axes (D46-70, eighth step)
  int pan_min_counts = -49467, pan_max_counts = 49467;   // +-159 deg
  int tilt_min_counts = -14622, tilt_max_counts = 9644;  // -47..+31 deg
  int max_speed_counts_s = 18700;                        // about 60 deg/s
  int min_speed_counts_s = 31;
  int base_speed_counts_s = 57;
  int acceleration_counts_s2 = 2000;  // factory default; the master raises it
  int baud = 9600;                    // at power-up: time a byte takes on the line; 0: none
  double reply_delay_s = 0.001;       // of the controller
  double reply_jitter_s = 0.0;        // uniform +-; the unit reads its counters within the delay
  double parameter_set_s = 0.0;       // that setting PA, PB, PU, PL takes (seconds on real units)
  bool echo = true;                   // factory default
  bool verbose = true;                // factory default
  bool home_at_power_up = true;
  bool homed_before = true;  // if not at power-up: somebody homed it before time began
  double home_speed_rad_s = 0.7;
};

class PtuUnit {
 public:
  PtuUnit(const PtuUnitConfig& config, std::uint64_t seed, double power_up_s);
  ~PtuUnit();

  // Bytes from the master; `time_s` is when the first of them begins on the line. Time never goes
  // back between calls of any method.
  void receive(std::string_view bytes, double time_s);

  // Bytes whose last bit is on the line by `time_s` and that were not handed out before.
  std::string transmit(double time_s);

  // When transmit() will next have something to give, as far as known now; nothing: the line stays
  // silent until it receives.
  std::optional<double> next_output_s() const;

  // The power goes and comes again: what was not saved is forgotten, also where it stood.
  void power_cycle(double time_s);
  // As if somebody had chosen so with RE or RD.
  void home_at_power_up(bool homes);
  // As if somebody had sent EE.
  void switch_echo_on(double time_s);
  // The pan mechanism gives way, unnoticed by the unit.
  void slip(double pan_rad, double time_s);

  // The rate of the master's port: another one than the unit's makes noise of every byte. 0, as at
  // first: it is always right.
  void set_master_baud(int baud);

  // True shaft angles of the mechanism (pan left positive, tilt up positive), continuous, at any
  // instant from two seconds back up to the latest time given to any method.
  PanTilt angles_at(double time_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
