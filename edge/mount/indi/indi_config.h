// The configuration of a telescope mount behind an INDI server. Pure.
#pragma once

#include <string>

#include "base/config/config_section.h"
#include "edge/mount/driven/drive.h"
#include "edge/mount/indi/telescope_axes.h"

namespace ols::indi {

struct IndiConfig {
  IndiConfig();

  std::string host = "localhost";
  int port = 7624;
  std::string device;  // as its driver names it: "Telescope Simulator"
  Axes axes = Axes::kEquatorial;
  std::string pier_side;     // "PIER_WEST", "PIER_EAST"; empty: that of the first connection
  mount::DriveConfig drive;  // positions in radians
};

config::Section indi_section(IndiConfig& config);  // of [mount]

}  // namespace ols::indi
