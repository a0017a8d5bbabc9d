// Writes into a station's status the borders of the directions that its mount can reach.
#pragma once

#include <vector>

#include "edge/station/borders.h"
#include "edge/station/station_report.h"
#include "ols_msg/station_status_t.hpp"

namespace ols::station {

void fill_borders(const std::vector<Border>& borders, ols_msg::station_status_t& message);

// As above; computes the borders from `chain`, with the tilts of the pose in `report`.
void fill_borders(ChainParameters chain, const StationReport& report,
                  ols_msg::station_status_t& message);

}  // namespace ols::station
