// Reads TOML keys that are the same in several kinds of files: key files, trust list, site
// settings. Errors name file, line and key.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/config/toml_config.h"

namespace ols::trust {

// Reads 64 hexadecimal digits: a private or public key, or the site's secret.
std::array<std::uint8_t, 32> read_hex(ConfigTable& table, const char* key);
// Accepts the same names as require_member_name().
std::string read_name(ConfigTable& table, const char* key);

// Throws std::invalid_argument unless the name is 1 to 32 letters, digits, - or _.
void require_member_name(const std::string& name);

}  // namespace ols::trust
