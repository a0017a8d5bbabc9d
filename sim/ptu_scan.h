// The simulated PTU's scan ("monitor"): it goes to and fro by itself until a byte comes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/ptu_motion.h"
#include "sim/ptu_setup.h"

namespace ols::sim {

class PtuScan {
 public:
  // Both must outlive it.
  PtuScan(PtuSetup& setup, PtuMotion& motion) : setup_(setup), motion_(motion) {}

  // The power comes.
  void power_up();

  // The answer; nothing: the command is not of the scan.
  std::optional<std::string> execute(std::string_view command, bool e_series, double time_s);
  // Between these [counts]: pan, or pan and tilt; none: over the whole range of pan.
  std::string start(const std::vector<int>& ends, double time_s);
  // Without a way back: the axis is wanted for something else.
  void end(int axis) { sweeps_[at(axis)].reset(); }

  // A byte has arrived, whichever: it ends a scan that began before.
  void interrupt(double time_s);
  // The legs up to an instant.
  void advance(double time_s);
  bool running() const { return sweeps_[0] || sweeps_[1]; }

 private:
  struct Sweep {
    double first, second;  // between them [counts]
    bool to_second;
    double begun_s;
  };

  PtuSetup& setup_;
  PtuMotion& motion_;
  std::array<std::optional<Sweep>, 2> sweeps_;
  std::vector<int> ends_;  // of the last scan
};

}  // namespace ols::sim
