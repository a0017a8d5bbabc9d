#include "tools/setup/membership.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "tools/key/site_files.h"
#include "tools/setup/site_time.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;
using trust::Role;

constexpr const char* kList = "/etc/ols/trust.toml";

// On the host itself.
std::string key_path(const std::string& name) { return "/etc/credstore/ols-" + name + ".key"; }

void say_join(const std::string& station, const trust::PublicKey& key) {
  std::printf(
      "\nAt the centre, where ROOT.KEY is the file of the site's root on its stick (compare the\n"
      "six words):\n  ols-key enrol %s --root ROOT.KEY --list %s --public %s\n  %s\n\n",
      station.c_str(), kList, trust::to_hex(key).c_str(), trust::spoken(key).c_str());
}

void keep_copy(const key::SiteFiles& files) {
  try {
    key::copy_list(files);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "there is no new copy of the trust list beside the root: %s\n",
                 problem.what());
  }
}

constexpr std::size_t kLargestKeys = 1'000'000;

}  // namespace

void keep_time(const Host& host, const trust::SiteKey& site) {
  const std::string path = host.path("/etc/chrony/chrony.keys");
  if (!fs::exists(path)) return;
  const std::string present = read_small_file(path, kLargestKeys);
  const std::string wanted = with_time_key(present, site);
  if (wanted == present) return;
  AtomicFile file(path);
  file.stream() << wanted;
  file.commit();
  std::printf("%s: written\n", path.c_str());
}

std::vector<std::string> join_site(const Host& host, const std::string& station,
                                   const key::Invitation& invitation) {
  host.folder("/etc/credstore", 0700);
  const std::string path = host.path(key_path(station));
  if (!fs::exists(path)) {
    keep_time(host, invitation.site);
    say_join(station, key::make_member_key(path, station, invitation));
    return {key_path(station)};
  }
  const trust::MemberKey key = trust::read_member_key(path);
  if (key.root != invitation.root || key.site_key != invitation.site || key.name != station) {
    throw std::invalid_argument(path + ": is the key of " + key.name +
                                ", or of another site; remove it to join this one");
  }
  keep_time(host, invitation.site);
  say_join(station, trust::SigningKey(key.seed).public_key());
  return {};
}

std::vector<std::string> make_site(const Host& host, const std::string& site,
                                   const std::string& root) {
  const key::SiteFiles files{root, host.folder("/etc/ols", 0755) + "/trust.toml"};
  if (!fs::exists(files.root)) {
    key::make_site(files, site);
  } else if (key::restore_list(files)) {
    std::printf("%s: restored from the copy beside the root\n", files.list.c_str());
  }
  host.folder("/etc/credstore", 0700);
  std::vector<std::string> made;
  for (const auto& [name, role] :
       {std::pair{"fusion", Role::kFusion}, std::pair{"console", Role::kOperator},
        std::pair{"operator", Role::kOperator}, std::pair{"logger", Role::kListener},
        std::pair{"exporter", Role::kListener}, std::pair{"export", Role::kListener},
        std::pair{"cue", Role::kCue}}) {
    const std::string path = host.path(key_path(name));
    if (fs::exists(path)) continue;
    key::enrol_with_key(files, {name, role}, path);
    made.push_back(key_path(name));
  }
  keep_copy(files);
  const trust::RootKey key = trust::read_root_key(files.root);
  keep_time(host, key.site_key);
  std::printf(
      "\nThe invitation of %s's stations, for their answers (it holds the site's secret: carry\n"
      "it, do not send it):\n  invitation = \"%s\"\n\n",
      key.site.c_str(), to_text(key::invitation_of(key)).c_str());
  return made;
}

}  // namespace ols::setup
