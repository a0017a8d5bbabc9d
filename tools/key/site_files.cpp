#include "tools/key/site_files.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/atomic_file.h"
#include "base/small_file.h"
#include "tools/key/site_book.h"

namespace ols::key {
namespace {

constexpr std::size_t kLargestFile = 20'000'000;

trust::TrustList write_list(const SiteFiles& files, const trust::TrustList& list,
                            const trust::RootKey& root) {
  AtomicFile file(files.list);
  file.stream() << sign_list(list, trust::SigningKey(root.seed));
  file.commit();
  return list;
}

}  // namespace

trust::TrustList make_site(const SiteFiles& files, const std::string& site) {
  if (std::filesystem::exists(files.list)) {
    throw std::system_error(EEXIST, std::generic_category(), files.list);
  }
  const trust::RootKey root{site, trust::draw_secret(), trust::draw_secret()};
  const trust::TrustList list = new_list(site, trust::SigningKey(root.seed).public_key());
  trust::write_root_key(files.root, root);
  return write_list(files, list, root);
}

trust::TrustList read_site(const SiteFiles& files, const trust::RootKey& root) {
  return trust::read_list(read_small_file(files.list, kLargestFile), files.list,
                          trust::SigningKey(root.seed).public_key());
}

Invitation invitation_of(const trust::RootKey& root) {
  return {root.site_key, trust::SigningKey(root.seed).public_key()};
}

trust::PublicKey make_member_key(const std::string& path, const std::string& name,
                                 const Invitation& invitation) {
  trust::require_member_name(name);
  const trust::MemberKey key{name, trust::draw_secret(), invitation.site, invitation.root};
  trust::write_member_key(path, key);
  return trust::SigningKey(key.seed).public_key();
}

trust::TrustList enrol_in(const SiteFiles& files, const trust::Member& member) {
  const trust::RootKey root = trust::read_root_key(files.root);
  return write_list(files, enrol(read_site(files, root), member), root);
}

trust::TrustList enrol_with_key(const SiteFiles& files, trust::Member member,
                                const std::string& key_path) {
  const trust::RootKey root = trust::read_root_key(files.root);
  const trust::TrustList before = read_site(files, root);
  // Before anything is written: a name or role that is refused must leave no key behind.
  member.key = trust::SigningKey(trust::draw_secret()).public_key();
  static_cast<void>(enrol(before, member));
  member.key = make_member_key(key_path, member.name, invitation_of(root));
  return write_list(files, enrol(before, member), root);
}

trust::TrustList revoke_in(const SiteFiles& files, const std::string& name) {
  const trust::RootKey root = trust::read_root_key(files.root);
  return write_list(files, revoke(read_site(files, root), name), root);
}

std::int64_t sign_settings_in(const SiteFiles& files, const std::string& wanted,
                              const std::string& path, std::int64_t above,
                              const trust::SettingsCheck& check) {
  const trust::RootKey root = trust::read_root_key(files.root);
  const trust::SigningKey key(root.seed);
  const std::string text = read_small_file(wanted, trust::kLargestSettings);
  check(trust::read_wanted_settings(text, wanted), wanted);
  trust::SiteSettings head;
  head.site = root.site;
  head.number = above + 1;
  if (std::filesystem::exists(path)) {
    const auto present = trust::read_settings(read_small_file(path, trust::kLargestSettings), path,
                                              key.public_key());
    head.number = std::max(head.number, present.number + 1);
  }
  const std::string made = trust::sign_settings(head, text, wanted, key);
  AtomicFile file(path);
  file.stream() << made;
  file.commit();
  return head.number;
}

}  // namespace ols::key
