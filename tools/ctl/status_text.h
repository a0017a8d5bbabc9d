// A station's status for a person's eyes.
#pragma once

#include <string>

#include "tools/ctl/operator.h"

namespace ols {

// One line a station, with a heading.
std::string status_table(const Operator::Statuses& statuses);
// Everything that one status tells. `now_utime_us` is this host's UTC.
std::string full_status(const ols_msg::station_status_t& status, std::int64_t now_utime_us);

}  // namespace ols
