// Reads keys that several files of this folder have. Errors name file, line and key.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "base/config/toml_config.h"

namespace ols::trust {

// 64 hexadecimal digits: a private or public key, or the site's secret.
std::array<std::uint8_t, 32> read_hex(ConfigTable& table, const char* key);
// Accepts the same names as require_member_name().
std::string read_name(ConfigTable& table, const char* key);

// Throws std::invalid_argument unless the name is 1 to 32 letters, digits, - or _.
void require_member_name(const std::string& name);

}  // namespace ols::trust
