#include "tools/key/site_files.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/config/toml_config.h"
#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "tools/key/trust_list_changes.h"

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

void copy_text(const std::string& from, const std::string& to) {
  AtomicFile file(to);
  file.stream() << read_small_file(from, kLargestFile);
  file.commit();
}

// The path of the copy; empty: none is needed.
std::string copy_path(const SiteFiles& files) {
  namespace fs = std::filesystem;
  const fs::path root = fs::absolute(files.root);
  const auto folder = fs::weakly_canonical(root.parent_path());
  if (folder == fs::weakly_canonical(fs::absolute(files.list).parent_path())) return "";
  return (root.parent_path() / root.stem()).string() + ".trust.toml";
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

namespace {

// For a change of the list: to change an older list than the copy would undo later revocations.
trust::TrustList read_newest(const SiteFiles& files, const trust::RootKey& root) {
  const trust::TrustList list = read_site(files, root);
  const std::string copy = copy_path(files);
  if (copy.empty() || !std::filesystem::exists(copy)) return list;
  const std::int64_t newest = read_site({files.root, copy}, root).number;
  if (newest <= list.number) return list;
  throw ConfigError(copy + ": is newer, list " + std::to_string(newest) + ", than " + files.list +
                    ", list " + std::to_string(list.number) + ": copy it there first");
}

}  // namespace

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
  return write_list(files, enrol(read_newest(files, root), member), root);
}

trust::TrustList enrol_with_key(const SiteFiles& files, trust::Member member,
                                const std::string& key_path) {
  const trust::RootKey root = trust::read_root_key(files.root);
  const trust::TrustList before = read_newest(files, root);
  // Before anything is written: a name or role that is refused must leave no key behind.
  member.key = trust::SigningKey(trust::draw_secret()).public_key();
  static_cast<void>(enrol(before, member));
  member.key = make_member_key(key_path, member.name, invitation_of(root));
  return write_list(files, enrol(before, member), root);
}

trust::TrustList revoke_in(const SiteFiles& files, const std::string& name) {
  const trust::RootKey root = trust::read_root_key(files.root);
  return write_list(files, revoke(read_newest(files, root), name), root);
}

std::string copy_list(const SiteFiles& files) {
  const std::string copy = copy_path(files);
  if (copy.empty()) return copy;
  static_cast<void>(read_newest(files, trust::read_root_key(files.root)));
  copy_text(files.list, copy);
  return copy;
}

bool restore_list(const SiteFiles& files) {
  const std::string copy = copy_path(files);
  if (copy.empty() || std::filesystem::exists(files.list) || !std::filesystem::exists(copy)) {
    return false;
  }
  copy_text(copy, files.list);
  return true;
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
