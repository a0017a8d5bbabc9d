// The trust list: the members of a site, with their roles and public keys, signed by the site's
// root. Each change gives the list a higher number; a list with a lower number never replaces one
// with a higher number.
//
//   site = "airfield"
//   number = 3
//   root = "…64 hexadecimal digits…"
//   [[member]]
//   name = "alfa"
//   role = "station"
//   key = "…64 hexadecimal digits…"
//   revoked = true
//   # signature …128 hexadecimal digits…
//
// The last line signs "OLS-trust-v1" and all lines before it, byte by byte. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/trust/channel_rules.h"
#include "base/trust/crypto.h"
#include "base/trust/trust_words.h"

namespace ols::trust {

struct Member {
  std::string name;  // a station's name is its id
  Role role = Role::kListener;
  PublicKey key{};
  bool revoked = false;
  std::string unknown_role{};  // the word of a role that this program does not know; otherwise
                               // empty
};

// The largest list that fits into a datagram of the bus [byte]: about 500 members.
inline constexpr std::size_t kLargestList = 60'000;

struct TrustList {
  std::string site;
  std::int64_t number = 0;
  PublicKey root{};
  std::vector<Member> members;  // names and keys are unique

  // The member of this name; null if there is none or it is revoked.
  const Member* find(std::string_view name) const;
  // The names of the stations that are not revoked.
  std::vector<std::string> stations() const;
  // "name (role), …" of the members whose role this program does not know.
  std::string strange_members() const;
  // "trust list 3: 4 members, revoked: bravo".
  std::string in_one_line() const;
};

// Returns the text of the file, with its signature.
std::string sign_list(const TrustList& list, const SigningKey& root);
// `name`: the file's name in errors. Throws ConfigError if this root has not signed the text as a
// list.
TrustList read_list(const std::string& text, const std::string& name, const PublicKey& root);
// Verifies the signature with the root key that the list itself states. This proves nothing about
// the site, because anybody can make a key.
TrustList read_list(const std::string& text, const std::string& name);

}  // namespace ols::trust
