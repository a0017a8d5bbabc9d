// The simulated PTU's scan ("monitor"): it moves to and fro on its own until a byte arrives.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/ptu/motion.h"
#include "sim/ptu/setup.h"

namespace ols::sim {

class PtuScan {
 public:
  // Both must outlive it.
  PtuScan(PtuSetup& setup, PtuMotion& motion) : setup_(setup), motion_(motion) {}

  // Power-up.
  void power_up();

  // The answer; nullopt: not a scan command.
  std::optional<std::string> execute(std::string_view command, bool e_series, double time_s);
  // Scans between these ends [counts]: pan, or pan and tilt; empty: the whole range of pan.
  std::string start(const std::vector<int>& ends, double time_s);
  // Ends the scan without returning home: another command needs the axis.
  void end(int axis) { sweeps_[at(axis)].reset(); }

  // A byte has arrived: ends a scan that began before it.
  void interrupt(double time_s);
  // Plans the legs up to an instant.
  void advance(double time_s);
  bool running() const { return sweeps_[0] || sweeps_[1]; }

 private:
  struct Sweep {
    double first, second;  // ends of the sweep [counts]
    bool to_second;
    double begun_s;
  };

  PtuSetup& setup_;
  PtuMotion& motion_;
  std::array<std::optional<Sweep>, 2> sweeps_;
  std::vector<int> ends_;  // of the last scan
};

}  // namespace ols::sim
