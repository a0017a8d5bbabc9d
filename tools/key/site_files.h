// A site's root, trust list and members' keys as files: what ols-key and ols-setup do with them.
#pragma once

#include <cstdint>
#include <string>

#include "base/trust/key_file.h"
#include "base/trust/site_settings.h"
#include "base/trust/trust_list.h"
#include "tools/key/invitation.h"

namespace ols::key {

struct SiteFiles {
  std::string root = "root.key", list = "trust.toml";
};

// All throw ConfigError, std::system_error or std::invalid_argument, and write nothing then.

// Root and an empty list; neither may be there. Returns the list.
trust::TrustList make_site(const SiteFiles& files, const std::string& site);
trust::TrustList read_site(const SiteFiles& files, const trust::RootKey& root);
Invitation invitation_of(const trust::RootKey& root);

// A new private key in a file of its own, which must not be there. Returns the public key.
trust::PublicKey make_member_key(const std::string& path, const std::string& name,
                                 const Invitation& invitation);

// A member whose key is made elsewhere. Returns the new list.
trust::TrustList enrol_in(const SiteFiles& files, const trust::Member& member);
// The same, with a new private key at `key_path`.
trust::TrustList enrol_with_key(const SiteFiles& files, trust::Member member,
                                const std::string& key_path);
trust::TrustList revoke_in(const SiteFiles& files, const std::string& name);

// A copy of the list beside the root (root.key: root.trust.toml), from which a centre whose disk is
// lost begins again. Returns its path; empty if the list itself is in that folder.
std::string copy_list(const SiteFiles& files);
// Whether the list was lost and is restored from the copy.
bool restore_list(const SiteFiles& files);

// The site's settings as `wanted`, a person's file, has them, signed, at `path`. Under the next
// number after those that are there, or after `above`. Returns the number.
std::int64_t sign_settings_in(const SiteFiles& files, const std::string& wanted,
                              const std::string& path, std::int64_t above,
                              const trust::SettingsCheck& check);

}  // namespace ols::key
