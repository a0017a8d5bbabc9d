// The configuration section of a FLIR unit as mount.
#pragma once

#include "edge/ptu/driver.h"

namespace ols::config {
struct Section;
}
namespace ols::ptu {

config::Section ptu_section(PtuConfig& config);  // the section [mount]

}  // namespace ols::ptu
