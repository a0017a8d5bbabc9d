#include "base/trust/trust_words.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "base/trust/crypto.h"

namespace ols::trust {

std::array<std::uint8_t, 32> read_hex(ConfigTable& table, const char* key) {
  const auto bytes = from_hex<32>(table.text(key, ""));
  if (!bytes) throw table.error(key, "must be 64 hexadecimal digits");
  return *bytes;
}

std::string read_name(ConfigTable& table, const char* key) {
  const std::string name = table.text(key, "");
  try {
    require_member_name(name);
  } catch (const std::invalid_argument& problem) {
    throw table.error(key, problem.what());
  }
  return name;
}

void require_member_name(const std::string& name) {
  constexpr std::size_t kLongest = 32;
  const bool good =
      !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
      });
  if (!good) throw std::invalid_argument("must be 1 to 32 letters, digits, - or _");
}

}  // namespace ols::trust
