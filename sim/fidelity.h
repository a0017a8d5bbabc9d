// What the lockstep simulation leaves out, and what its operators do wrong.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace ols::sim {

// What the operator marks at one station in place of the first target.
struct Misdesignation {
  std::string station;
  std::size_t target = 0;                            // of the scenario; its box,
  Eigen::Vector2d off_px = Eigen::Vector2d::Zero();  // beside it by this,
  double scale = 1.0;                                // and so many times as large
};

struct Fidelity {
  bool pictures = true;  // false: the pixel is the truth with noise of this deviation
  double pixel_sd_px = 0.3;
  std::vector<std::string> not_designated = {};  // stations that the operator leaves alone
  std::vector<Misdesignation> misdesignated = {};
};

}  // namespace ols::sim
