// Judges the bridge to other sites by the status that it writes. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "tools/doctor/finding.h"

namespace ols::doctor {

// `status`: the text of the bridge's status file; empty: there is no file.
Findings judge_bridge(const std::string& status, std::int64_t utime_us);

}  // namespace ols::doctor
