// The simulated PTU's numbered preset positions.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "sim/ptu/motion.h"

namespace ols::sim {

class PtuPresets {
 public:
  // `motion` must outlive this object.
  explicit PtuPresets(PtuMotion& motion) : motion_(motion) {}

  // Executes a preset command and returns the answer; nullopt: the command is not one.
  std::optional<std::string> execute(std::string_view command, double time_s);

 private:
  PtuMotion& motion_;
  std::map<int, std::pair<int, int>> places_;  // pan and tilt [counts]
};

}  // namespace ols::sim
