// An invitation tells a new member about its site: the secret for site tags and the root's public
// key, as 128 hexadecimal digits. Pure.
#pragma once

#include <string>

#include "base/trust/crypto.h"

namespace ols::key {

struct Invitation {
  trust::SiteKey site{};
  trust::PublicKey root{};
};

std::string to_text(const Invitation& invitation);
// Throws std::invalid_argument.
Invitation invitation_from(const std::string& text);

}  // namespace ols::key
