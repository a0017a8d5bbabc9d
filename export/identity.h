// Permanent names of objects. A name is computed only from what the object's messages state.
// Therefore an object keeps its name when ols-export restarts, and has the same name in a second
// ols-export. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// "SITE.target.BOOT.NUMBER". The boot is needed because each start of the fusion numbers its
// targets from the beginning.
std::string target_uid(const std::string& site, std::int64_t boot_id, std::int64_t target_id);
std::string station_uid(const std::string& site, const std::string& station);
std::string line_uid(const std::string& site, const std::string& station);
// "SITE.incident.NUMBER.BEGUN". The time is needed because another console may use the same
// numbers.
std::string incident_uid(const std::string& site, std::int64_t number, std::int64_t begun_us);

}  // namespace ols::exports
