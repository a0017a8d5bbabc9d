// Configures a host's time service from its answers. The time comes from GNSS, or else from the
// site's other hosts. These authenticate it with a key that all members derive from the site's
// secret. Pure.
#pragma once

#include <string>
#include <vector>

#include "base/trust/crypto.h"

namespace ols::setup {

// The number of the site's key in chrony's key file.
inline constexpr int kTimeKey = 7316;

// The text of /etc/chrony/conf.d/ols-site.conf. `neighbours`: addresses of the other hosts.
std::string chrony_file(const std::vector<std::string>& neighbours);
// The text of /etc/chrony/conf.d/ols-gnss.conf, with which the time comes from gpsd's receiver. It
// has no effect while the receiver has no fix.
std::string receiver_chrony_file();
// The text of /etc/chrony/chrony.keys (`present`) with the site's key; all other lines are
// unchanged.
std::string with_time_key(const std::string& present, const trust::SiteKey& site);

}  // namespace ols::setup
