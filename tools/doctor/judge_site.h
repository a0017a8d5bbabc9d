// Is it well, and if not, what to do: bus, station, host, services. Pure.
#pragma once

#include "edge/host_monitor.h"
#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

namespace ols::doctor {

Findings judge(const BusHeard& bus);
// The others on the bus; `own`: this host's station, empty at the centre.
Findings judge_company(const BusHeard& bus, const std::string& own);
Findings judge(const StationHeard& station);

Finding judge(const clock::ClockQuality& clock);
Finding judge(const FolderFacts& folder);
Findings judge(const station::HostReport& host);
// Nothing when there is no such unit on this host.
std::optional<Finding> judge(const UnitFacts& unit);

// The blocks that `systemctl show -p Id,LoadState,ActiveState,SubState,Result,NRestarts,StatusText`
// prints, one a unit.
std::vector<UnitFacts> parse_units(const std::string& text);
// The interface in the words of `ip -o route get ADDRESS`; empty: none.
std::string parse_route(const std::string& text);

}  // namespace ols::doctor
