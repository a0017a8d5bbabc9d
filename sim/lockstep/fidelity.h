// The simplifications of the lockstep simulation, and the mistakes of its operators.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "central/handover/handover_policy.h"

namespace ols::sim {

// A station's operator makes a wrong designation, instead of designating the first target.
struct Misdesignation {
  std::string station;
  std::size_t target = 0;  // index in the scenario; its box is designated,
  Eigen::Vector2d off_px = Eigen::Vector2d::Zero();  // shifted by this
  double scale = 1.0;                                // and scaled by this about its middle
};

struct Fidelity {
  bool pictures = true;  // false: no images; the measured pixel is the true one plus noise
  double pixel_sd_px = 0.3;
  std::vector<std::string> not_designated = {};  // stations without a designation
  std::vector<Misdesignation> misdesignated = {};
  fusion::HandoverConfig handover{};
  bool land_model = true;  // false: the fusion knows nothing of the land
};

}  // namespace ols::sim
