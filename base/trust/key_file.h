// The files of private keys. Only the computer's user root can read them. A member's file also
// holds the secret for site tags and the public key of the site's root:
//
//   name = "alfa"
//   seed = "…64 hexadecimal digits…"   # never leaves this file
//   site_key = "…"                     # a secret of all members
//   root = "…"                         # public
#pragma once

#include <string>

#include "base/trust/crypto.h"

namespace ols::trust {

struct MemberKey {
  std::string name;
  Seed seed{};
  SiteKey site_key{};
  PublicKey root{};
};

struct RootKey {
  std::string site;
  Seed seed{};
  SiteKey site_key{};
};

// Both throw ConfigError, or std::system_error naming the file. A file that other users can read is
// refused, because its keys are no longer secret.
MemberKey read_member_key(const std::string& path);
RootKey read_root_key(const std::string& path);

// Both create the file with mode 0600. They throw std::system_error if the file exists.
void write_member_key(const std::string& path, const MemberKey& key);
void write_root_key(const std::string& path, const RootKey& key);

}  // namespace ols::trust
