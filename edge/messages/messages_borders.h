// Writes the borders of the region in which a unit can point into a station's status.
#pragma once

#include <vector>

#include "edge/station/borders.h"
#include "edge/station/station_report.h"
#include "ols_msg/station_status_t.hpp"

namespace ols::station {

void fill_borders(const std::vector<Border>& borders, ols_msg::station_status_t& message);

// As above, for a unit that stands as the station's pose says.
void fill_borders(ChainParameters chain, const StationReport& report,
                  ols_msg::station_status_t& message);

}  // namespace ols::station
