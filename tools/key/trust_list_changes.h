// The changes that the holder of a site's root key makes to the site's trust list. Pure.
#pragma once

#include <string>

#include "base/trust/trust_list.h"

namespace ols::key {

// Makes list number 1, without members. Throws std::invalid_argument for a bad name.
trust::TrustList new_list(const std::string& site, const trust::PublicKey& root);

// Returns the next list, with this member. If the member already has a key, the new key replaces
// it, and the old key is revoked. Throws std::invalid_argument if the list has the name with
// another role, or has the key already.
trust::TrustList enrol(const trust::TrustList& list, const trust::Member& member);

// Returns the next list, with this member's keys revoked. Throws std::invalid_argument if there is
// no such member.
trust::TrustList revoke(const trust::TrustList& list, const std::string& name);

// A table for a person.
std::string describe(const trust::TrustList& list);

}  // namespace ols::key
