// The time service of a host by its answers: GNSS first, the site's other hosts where there is
// none, authenticated by a key that all members can make of the site's secret. Pure.
#pragma once

#include <string>
#include <vector>

#include "base/trust/crypto.h"

namespace ols::setup {

// Of the site's key among those of chrony.
inline constexpr int kTimeKey = 7316;

// /etc/chrony/conf.d/ols-site.conf. `neighbours`: addresses of the other hosts.
std::string chrony_file(const std::vector<std::string>& neighbours);
// /etc/chrony/conf.d/ols-gnss.conf: time from gpsd's receiver. Without a fix it does nothing.
std::string receiver_chrony_file();
// /etc/chrony/chrony.keys with the site's key, all other lines as they were.
std::string with_time_key(const std::string& present, const trust::SiteKey& site);

}  // namespace ols::setup
