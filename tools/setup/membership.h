// How a host becomes a member of its site, with its private keys in /etc/credstore.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/answers.h"
#include "tools/setup/host.h"

namespace ols::setup {

// A station makes its own key, unless it has one of this site. Says what is to be run at the
// centre. Both return the paths of the keys that were made. Throws ConfigError, std::system_error;
// std::invalid_argument for a key of another site.
std::vector<std::string> join_site(const Host& host, const std::string& station,
                                   const key::Invitation& invitation);

// The centre: the root and the list, unless they are there, and a key for each of its programs. A
// list that is lost is restored from the copy beside the root. Says the invitation of the stations.
std::vector<std::string> make_site(const Host& host, const std::string& site,
                                   const std::string& root);

// The key by which the hosts of a site believe each other's time, for chrony. No file: no chrony.
void keep_time(const Host& host, const trust::SiteKey& site);

}  // namespace ols::setup
