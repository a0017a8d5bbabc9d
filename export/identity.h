// Names that stay the same: computed from what the bus says, never counted here, so that a restart
// of ols-export, or a second one, gives an object the same name. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::exports {

// "SITE.target.BOOT.NUMBER": the fusion's numbers begin again with each of its starts.
std::string target_uid(const std::string& site, std::int64_t boot_id, std::int64_t target_id);
std::string station_uid(const std::string& site, const std::string& station);
std::string line_uid(const std::string& site, const std::string& station);

}  // namespace ols::exports
