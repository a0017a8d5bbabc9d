// The PTU's part of a station's configuration file.
#pragma once

#include "edge/ptu/driver.h"

namespace ols::config {
struct Section;
}
namespace ols::ptu {

config::Section ptu_section(PtuConfig& config);  // [ptu]

}  // namespace ols::ptu
