// LCM's URLs, looked at before LCM sees them: it takes malformed ones without a word.
#pragma once

#include <netinet/in.h>

#include <optional>
#include <string>

#include "base/toml_config.h"

namespace ols {

// The group of udpm://ADDRESS:PORT?options, LCM's defaults filled in; nothing for LCM's other kinds
// (tcpq, memq, file, mpudpm). Throws std::invalid_argument saying what is wrong.
std::optional<sockaddr_in> multicast_group(const std::string& url);

// The key's URL, or the fallback. Throws ConfigError when it is malformed.
std::string read_lcm_url(ConfigTable& table, const std::string& key, const std::string& fallback);

}  // namespace ols
