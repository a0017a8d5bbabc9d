// Reads and writes the files of a site's root key, trust list and members' keys, for ols-key and
// ols-setup.
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

// If one of these functions throws (ConfigError, std::system_error or std::invalid_argument), it
// has written nothing.

// Creates the root key and an empty list; neither may exist. Returns the list.
trust::TrustList make_site(const SiteFiles& files, const std::string& site);
trust::TrustList read_site(const SiteFiles& files, const trust::RootKey& root);
Invitation invitation_of(const trust::RootKey& root);

// Creates a new private key in its own file, which must not exist. Returns the public key.
trust::PublicKey make_member_key(const std::string& path, const std::string& name,
                                 const Invitation& invitation);

// Enrols a member whose key was made elsewhere. Returns the new list.
trust::TrustList enrol_in(const SiteFiles& files, const trust::Member& member);
// Does the same with a new private key, which it creates at `key_path`.
trust::TrustList enrol_with_key(const SiteFiles& files, trust::Member member,
                                const std::string& key_path);
trust::TrustList revoke_in(const SiteFiles& files, const std::string& name);

// Copies the list into the root key's folder (root.key: root.trust.toml), in order to restore a
// centre after the loss of its disk. Returns the path of the copy; empty if the list itself is in
// that folder.
std::string copy_list(const SiteFiles& files);
// Restores the list from the copy if it is missing. Returns whether it was missing.
bool restore_list(const SiteFiles& files);

// Signs the settings in a person's file `wanted`, and writes them to `path`. Their number is one
// more than the greater of two numbers: that of the existing settings, and `above`. Returns the
// number.
std::int64_t sign_settings_in(const SiteFiles& files, const std::string& wanted,
                              const std::string& path, std::int64_t above,
                              const trust::SettingsCheck& check);

}  // namespace ols::key
