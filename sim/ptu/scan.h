// The simulated PTU's scan ("monitor"): the unit moves to and fro until a byte arrives.
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
  // `setup` and `motion` must outlive this object.
  PtuScan(PtuSetup& setup, PtuMotion& motion) : setup_(setup), motion_(motion) {}

  // Powers up: no scan runs, and the ends of the last one are forgotten.
  void power_up();

  // Executes a scan command and returns the answer; nullopt: the command is not one.
  std::optional<std::string> execute(std::string_view command, bool e_series, double time_s);
  // Scans between these ends [counts]: two of pan, or two of pan and two of tilt; empty: the whole
  // range of pan.
  std::string start(const std::vector<int>& ends, double time_s);
  // Ends the scan of one axis without moving it home, because another command uses the axis.
  void end(int axis) { sweeps_[at(axis)].reset(); }

  // A byte has arrived: it ends a scan that began earlier; the axes move home.
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
