// The configuration of a FLIR unit.
#pragma once

#include "edge/ptu/driver.h"

namespace ols::config {
struct Section;
}
namespace ols::ptu {

config::Section ptu_section(PtuConfig& config);  // the section [mount]

}  // namespace ols::ptu
