// Names that stay the same. They are computed from the bus's data, never counted here, so a restart
// of ols-export, or a second one, gives an object the same name. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// "SITE.target.BOOT.NUMBER": the fusion's numbers start again at each of its starts.
std::string target_uid(const std::string& site, std::int64_t boot_id, std::int64_t target_id);
std::string station_uid(const std::string& site, const std::string& station);
std::string line_uid(const std::string& site, const std::string& station);
// "SITE.incident.NUMBER.BEGUN": the numbers of another console are the same, its times are not.
std::string incident_uid(const std::string& site, std::int64_t number, std::int64_t begun_us);

}  // namespace ols::exports
