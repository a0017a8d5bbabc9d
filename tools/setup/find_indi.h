// Finds the telescope mounts behind an INDI server. Connects no mount and moves nothing.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/finders.h"

namespace ols::setup {

// Empty: no server answers, or none of its devices is a telescope.
std::vector<Found> find_indi(const std::string& host, int port);

}  // namespace ols::setup
