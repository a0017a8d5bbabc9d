// A host's time service, from its answers: GNSS first, otherwise the site's other hosts,
// authenticated by a key that all members derive from the site's secret. Pure.
#pragma once

#include <string>
#include <vector>

#include "base/trust/crypto.h"

namespace ols::setup {

// The number of the site's key in chrony's key file.
inline constexpr int kTimeKey = 7316;

// /etc/chrony/conf.d/ols-site.conf. `neighbours`: addresses of the other hosts.
std::string chrony_file(const std::vector<std::string>& neighbours);
// /etc/chrony/conf.d/ols-gnss.conf: time from gpsd's receiver. Without a fix it has no effect.
std::string receiver_chrony_file();
// /etc/chrony/chrony.keys with the site's key; all other lines are unchanged.
std::string with_time_key(const std::string& present, const trust::SiteKey& site);

}  // namespace ols::setup
