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
  std::string device;  // the driver's name of the device: "Telescope Simulator"
  Axes axes = Axes::kEquatorial;
  std::string pier_side;  // "PIER_WEST" or "PIER_EAST"; if empty, the side at the first connection
  mount::DriveConfig drive;  // positions and velocities in radians
};

config::Section indi_section(IndiConfig& config);  // the section [mount]

}  // namespace ols::indi
