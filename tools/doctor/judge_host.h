// Judges clock, disk, processor and services of this host and advises what to do. Pure.
#pragma once

#include "edge/process/host_monitor.h"
#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

namespace ols::doctor {

Finding judge(const clock::ClockQuality& clock);
Finding judge(const FolderFacts& folder);
Findings judge(const station::HostReport& host);
// Judges a systemd unit; nullopt: there is no such unit on this host.
std::optional<Finding> judge(const UnitFacts& unit);

// Parses the output of `systemctl show -p
// Id,LoadState,ActiveState,SubState,Result,NRestarts,StatusText`, which has one block per unit.
std::vector<UnitFacts> parse_units(const std::string& text);
// The interface in the output of `ip -o route get ADDRESS`; empty: the output names no interface.
std::string parse_route(const std::string& text);

}  // namespace ols::doctor
