// The simplifications of the lockstep simulation, and the mistakes of its operators.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "central/handover/handover_policy.h"

namespace ols::sim {

// A wrong designation by a station's operator, instead of the first target.
struct Misdesignation {
  std::string station;
  std::size_t target = 0;                            // of the scenario; its box,
  Eigen::Vector2d off_px = Eigen::Vector2d::Zero();  // shifted by this
  double scale = 1.0;                                // and scaled by this
};

struct Fidelity {
  bool pictures = true;  // false: the pixel is the truth plus noise of this sd
  double pixel_sd_px = 0.3;
  std::vector<std::string> not_designated = {};  // stations without a designation
  std::vector<Misdesignation> misdesignated = {};
  fusion::HandoverConfig handover{};
  bool land_model = true;  // false: the fusion knows nothing of the land
};

}  // namespace ols::sim
