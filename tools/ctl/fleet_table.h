// Formats an overview of all stations for a person: calibration, clock, disk, temperature, newest
// alarm. Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ols_msg/station_status_t.hpp"

namespace ols::ctl {

// One line per station: first the stations whose status was received, then the other enrolled
// stations.
std::string fleet_table(const std::map<std::string, ols_msg::station_status_t>& statuses,
                        const std::vector<std::string>& enrolled = {});

}  // namespace ols::ctl
