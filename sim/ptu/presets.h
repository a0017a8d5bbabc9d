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
  // `motion` must outlive it.
  explicit PtuPresets(PtuMotion& motion) : motion_(motion) {}

  // The answer; nullopt: not a preset command.
  std::optional<std::string> execute(std::string_view command, double time_s);

 private:
  PtuMotion& motion_;
  std::map<int, std::pair<int, int>> places_;  // pan and tilt [counts]
};

}  // namespace ols::sim
