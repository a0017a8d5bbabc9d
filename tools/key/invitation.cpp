#include "tools/key/invitation.h"

#include <stdexcept>

namespace ols::key {

std::string to_text(const Invitation& invitation) {
  return trust::to_hex(invitation.site) + trust::to_hex(invitation.root);
}

Invitation invitation_from(const std::string& text) {
  constexpr std::size_t kHex = 64;
  const bool whole = text.size() == 2 * kHex;
  const auto site = trust::from_hex<32>(whole ? text.substr(0, kHex) : "");
  const auto root = trust::from_hex<32>(whole ? text.substr(kHex) : "");
  if (!site || !root) {
    throw std::invalid_argument("must be the 128 hexadecimal digits of ols-key invite");
  }
  return {*site, *root};
}

}  // namespace ols::key
