// Formats a station's status for a person.
#pragma once

#include <string>

#include "tools/ctl/operator.h"

namespace ols::ctl {

// A table with one line per station.
std::string status_table(const Operator::Statuses& statuses);
// All values of one status. `now_utime_us` is this host's UTC.
std::string full_status(const ols_msg::station_status_t& status, std::int64_t now_utime_us);

}  // namespace ols::ctl
