// Judges the bus and the stations whose statuses arrive on it, and advises what to do. Pure.
#pragma once

#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

namespace ols::doctor {

Findings judge(const BusFacts& bus);
// Judges the other hosts on the bus. `own`: this host's station; empty at the centre.
Findings judge_company(const BusFacts& bus, const std::string& own);
Findings judge(const StationFacts& station);

}  // namespace ols::doctor
