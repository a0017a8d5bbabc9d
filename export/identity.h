// Permanent names of objects. A name is computed from the object's messages alone, without a
// counter of this process. So an object keeps its name when ols-export restarts, and has the same
// name in a second ols-export. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// "SITE.target.BOOT.NUMBER": the fusion's numbers start again at each of its starts.
std::string target_uid(const std::string& site, std::int64_t boot_id, std::int64_t target_id);
std::string station_uid(const std::string& site, const std::string& station);
std::string line_uid(const std::string& site, const std::string& station);
// "SITE.incident.NUMBER.BEGUN": another console may use the same numbers, but at other times.
std::string incident_uid(const std::string& site, std::int64_t number, std::int64_t begun_us);

}  // namespace ols::exports
