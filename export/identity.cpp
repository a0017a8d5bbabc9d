#include "export/identity.h"

#include "conditions/printed.h"

namespace ols::exports {

std::string target_uid(const std::string& site, std::int64_t boot_id, std::int64_t target_id) {
  return site + ".target." +
         printed("%016llx.%lld", static_cast<unsigned long long>(boot_id),
                 static_cast<long long>(target_id));
}

std::string station_uid(const std::string& site, const std::string& station) {
  return site + ".station." + station;
}

std::string line_uid(const std::string& site, const std::string& station) {
  return site + ".line." + station;
}

std::string incident_uid(const std::string& site, std::int64_t number, std::int64_t begun_us) {
  return site + ".incident." + std::to_string(number) + "." + std::to_string(begun_us);
}

}  // namespace ols::exports
