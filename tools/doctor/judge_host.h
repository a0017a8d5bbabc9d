// Judges clock, disk, processor and services of this host, and says what to do. Pure.
#pragma once

#include "edge/process/host_monitor.h"
#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

namespace ols::doctor {

Finding judge(const clock::ClockQuality& clock);
Finding judge(const FolderFacts& folder);
Findings judge(const station::HostReport& host);
// nullopt if there is no such unit on this host.
std::optional<Finding> judge(const UnitFacts& unit);

// The blocks printed by `systemctl show -p
// Id,LoadState,ActiveState,SubState,Result,NRestarts,StatusText`, one per unit.
std::vector<UnitFacts> parse_units(const std::string& text);
// The interface in the output of `ip -o route get ADDRESS`; empty: it names none.
std::string parse_route(const std::string& text);

}  // namespace ols::doctor
