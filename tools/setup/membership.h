// Makes a host a member of its site, with its private keys in /etc/credstore.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/answers.h"
#include "tools/setup/host.h"

namespace ols::setup {

// For a station: creates its key, unless it has a key of this site, and prints the command that
// must be run at the centre. This function and make_site() return the paths of new keys. They throw
// ConfigError, std::system_error, and std::invalid_argument if there is a key of another site.
std::vector<std::string> join_site(const Host& host, const std::string& station,
                                   const key::Invitation& invitation);

// For the centre: creates the root key and the trust list, unless they exist, and a key for each of
// the centre's programs. Restores a lost list from the copy beside the root key. Prints the
// invitation for stations.
std::vector<std::string> make_site(const Host& host, const std::string& site,
                                   const std::string& root);

// Gives chrony the key with which the hosts of a site authenticate their time messages. Does
// nothing if chrony has no key file.
void keep_time(const Host& host, const trust::SiteKey& site);

}  // namespace ols::setup
