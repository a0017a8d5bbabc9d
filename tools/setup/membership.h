// How a host becomes a member of its site, with its private keys in /etc/credstore.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/answers.h"
#include "tools/setup/host.h"

namespace ols::setup {

// A station creates its own key, unless it has one of this site, and prints the command to be run
// at the centre. Both functions return the paths of new keys. Throw ConfigError, std::system_error;
// std::invalid_argument for a key of another site.
std::vector<std::string> join_site(const Host& host, const std::string& station,
                                   const key::Invitation& invitation);

// The centre: the root key and the list, unless they exist, and a key for each of its programs. A
// lost list is restored from the copy beside the root key. Prints the stations' invitation.
std::vector<std::string> make_site(const Host& host, const std::string& site,
                                   const std::string& root);

// Gives chrony the key by which the hosts of a site authenticate each other's time. Does nothing if
// chrony has no key file.
void keep_time(const Host& host, const trust::SiteKey& site);

}  // namespace ols::setup
