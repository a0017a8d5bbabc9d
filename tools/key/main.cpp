// ols-key: the keys and the trust list of a site. Parses, reads, writes.
#include <sys/stat.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/bus/log_reader.h"
#include "base/config/config_section.h"
#include "base/config/toml_config.h"
#include "base/files/small_file.h"
#include "base/process/command_line.h"
#include "base/trust/key_file.h"
#include "edge/config/config.h"
#include "tools/key/log_check.h"
#include "tools/key/site_files.h"
#include "tools/key/trust_list_changes.h"

namespace {

namespace fs = std::filesystem;
namespace trust = ols::trust;

constexpr int kExitNotVerified = 1;
constexpr std::size_t kLargestFile = 20'000'000;

struct Words {
  std::string site, name, role = "station", root = "root.key", list = "trust.toml", key, public_key;
  std::string log, lists, root_public, settings, output = "site.toml";
};

ols::key::SiteFiles files_of(const Words& words) { return {words.root, words.list}; }

// The change itself stays, even if the stick cannot be written.
void keep_copy(const Words& words) {
  try {
    const std::string copy = ols::key::copy_list(files_of(words));
    if (!copy.empty()) std::printf("%s: its copy\n", copy.c_str());
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "ols-key: there is no new copy of the list beside the root: %s\n",
                 problem.what());
  }
}

void say_list(const Words& words, const trust::TrustList& list) {
  std::printf("%s: list %lld\n", words.list.c_str(), static_cast<long long>(list.number));
  keep_copy(words);
  if (fs::file_size(words.list) <= trust::kLargestList) return;
  std::fprintf(stderr, "ols-key: the list is too large for the bus: copy it to %s\n",
               "/etc/ols/trust.toml of every host");
}

trust::PublicKey public_from(const std::string& hex, const char* what) {
  const auto key = trust::from_hex<32>(hex);
  if (!key) throw std::invalid_argument(std::string(what) + ": must be 64 hexadecimal digits");
  return *key;
}

void site_new(const Words& words) {
  const trust::TrustList list = ols::key::make_site(files_of(words), words.site);
  say_list(words, list);
  std::printf("%s: the root of %s, public key %s\n  %s\n", words.root.c_str(), words.site.c_str(),
              trust::to_hex(list.root).c_str(), trust::spoken(list.root).c_str());
}

// What a member needs to know of its site, for a key that is made elsewhere.
void invite(const Words& words) {
  const auto invitation = ols::key::invitation_of(trust::read_root_key(words.root));
  std::printf("ols-key make NAME --invitation %s\n", ols::key::to_text(invitation).c_str());
}

std::string key_path(const Words& words) {
  return words.key.empty() ? words.name + ".key" : words.key;
}

void say_key(const Words& words) {
  std::printf("%s: the private key of %s\n", key_path(words).c_str(), words.name.c_str());
}

// On the member's own host: the key never leaves it.
void make(const Words& words, const std::string& invitation) {
  ols::key::Invitation known;
  try {
    known = ols::key::invitation_from(invitation);
  } catch (const std::invalid_argument& problem) {
    throw std::invalid_argument("--invitation: " + std::string(problem.what()));
  }
  const trust::PublicKey key = ols::key::make_member_key(key_path(words), words.name, known);
  say_key(words);
  std::printf(
      "enrol it where the root is, and compare the six words:\n"
      "  ols-key enrol %s --public %s\n  %s\n",
      words.name.c_str(), trust::to_hex(key).c_str(), trust::spoken(key).c_str());
}

void enrol(const Words& words) {
  trust::Member member{words.name, *trust::role_from(words.role)};
  trust::TrustList list;
  if (!words.public_key.empty()) {
    member.key = public_from(words.public_key, "--public");
    list = ols::key::enrol_in(files_of(words), member);
  } else {
    list = ols::key::enrol_with_key(files_of(words), member, key_path(words));
    say_key(words);
  }
  say_list(words, list);
  std::printf("%s, %s\n  %s\n", words.name.c_str(), words.role.c_str(),
              trust::spoken(list.find(words.name)->key).c_str());
}

void revoke(const Words& words) {
  say_list(words, ols::key::revoke_in(files_of(words), words.name));
}

// Reads the settings as every station will.
void check_settings(const trust::SiteSettings& site, const std::string& name) {
  ols::ConfigFile file(site.body, name);
  ols::station::StationSettings station;
  ols::config::read(ols::station::site_section(station), file.root().table("station"));
}

void settings(const Words& words, std::int64_t above) {
  const std::int64_t number = ols::key::sign_settings_in(files_of(words), words.settings,
                                                         words.output, above, check_settings);
  std::printf("%s: site settings %lld\n", words.output.c_str(), static_cast<long long>(number));
}

void list(const Words& words) {
  const std::string text = ols::read_small_file(words.list, kLargestFile);
  const trust::TrustList list =
      words.root_public.empty()
          ? trust::read_list(text, words.list)
          : trust::read_list(text, words.list, public_from(words.root_public, "--root-public"));
  std::fputs(ols::key::describe(list).c_str(), stdout);
}

ols::key::Lists lists_in(const fs::path& folder, const Words& words) {
  ols::key::Lists lists;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("trust") || entry.path().extension() != ".toml") continue;
    const std::string text = ols::read_small_file(entry.path().string(), kLargestFile);
    const auto root = words.root_public.empty() ? trust::read_list(text, name).root
                                                : public_from(words.root_public, "--root-public");
    trust::TrustList list = trust::read_list(text, name, root);
    if (!lists.empty() && lists.begin()->second.root != list.root) {
      throw std::invalid_argument(name + ": is of another site than the other lists in " +
                                  folder.string() + "; say --root-public");
    }
    lists[list.number] = std::move(list);
  }
  if (lists.empty()) throw std::invalid_argument(folder.string() + ": no trust-*.toml in it");
  return lists;
}

// Reads until `look` has seen enough; returns what is damaged up to there, in words.
template <class Look>
std::string read_log(const std::string& path, Look look) {
  ols::LogReader log(path, ols::LogTimes::kAsRecorded);
  while (const auto message = log.next()) {
    std::vector<std::uint8_t> recorded = message->payload;
    recorded.insert(recorded.end(), message->trailer.begin(), message->trailer.end());
    if (!look(message->channel, trust::Bytes(recorded), message->received_utime_us)) break;
  }
  return log.damage();
}

// The list under which the log begins: ols-logger writes it at the head of each.
std::int64_t first_list(const std::string& path, const ols::key::Lists& lists) {
  std::optional<std::int64_t> first;
  read_log(path, [&](std::string_view channel, trust::Bytes message, std::int64_t /*utime_us*/) {
    first = ols::key::told_number(lists, channel, message);
    return !first;
  });
  if (first) return *first;
  const std::int64_t newest = lists.rbegin()->first;
  std::printf("the log tells no trust list: verified with the newest, %lld\n",
              static_cast<long long>(newest));
  return newest;
}

int verify(const Words& words) {
  const fs::path folder =
      words.lists.empty() ? fs::absolute(words.log).parent_path() : fs::path(words.lists);
  const ols::key::Lists lists = lists_in(folder, words);
  ols::key::LogCheck check(lists, first_list(words.log, lists));
  const auto add = [&](std::string_view channel, trust::Bytes message, std::int64_t utime_us) {
    check.add(channel, message, utime_us);
    return true;
  };
  const std::string damage = read_log(words.log, add);
  std::fputs(check.text().c_str(), stdout);
  if (!damage.empty()) {
    std::printf("not verified, as it cannot be read: %s\n", damage.c_str());
  }
  std::string numbers;
  for (const std::int64_t number : check.in_force()) numbers += " " + std::to_string(number);
  std::printf("trust lists in force, in their order:%s\n", numbers.c_str());
  if (words.root_public.empty()) {
    std::printf("verified against the root that the lists name; --root-public KEY proves which\n");
  }
  return check.bad() == 0 && damage.empty() ? 0 : kExitNotVerified;
}

void add_root_and_list(CLI::App& command, Words& words) {
  command.add_option("--root", words.root, "File of the site's root key")->capture_default_str();
  command.add_option("--list", words.list, "File of the trust list")->capture_default_str();
}

CLI::App* add_settings(CLI::App& app, Words& words, std::int64_t& above) {
  auto* set = app.add_subcommand("settings",
                                 "Sign the settings that are the same on all hosts of the site");
  set->add_option("file", words.settings, "TOML file with geoid and [station]")->required();
  set->add_option("--root", words.root, "File of the site's root key")->capture_default_str();
  set->add_option("--output", words.output, "File of the signed settings")->capture_default_str();
  set->add_option(
         "--above", above,
         "Number of the settings that the stations have, if the file of the last ones is lost")
      ->check(CLI::Range(0, 999'999'999));
  return set;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The keys and the trust list of a site (docs/security.md)"};
  app.set_version_flag("--version", OLS_VERSION);
  Words words;
  std::string invitation;
  app.require_subcommand(1);
  auto* site = app.add_subcommand("site-new", "Make a site: its root key, its secret, its list");
  site->add_option("site", words.site, "Name of the site")->required();
  add_root_and_list(*site, words);
  auto* invited = app.add_subcommand("invite", "Print what a member needs to make its own key");
  invited->add_option("--root", words.root, "File of the site's root key")->capture_default_str();
  auto* made = app.add_subcommand("make", "Make a member's key on its own host");
  made->add_option("name", words.name, "Name of the member; of a station: its id")->required();
  made->add_option("--invitation", invitation, "What ols-key invite has printed")->required();
  made->add_option("--key", words.key, "File to write; else NAME.key");
  auto* enrolled = app.add_subcommand("enrol", "Enter a member into the list; make its key too");
  enrolled->add_option("name", words.name, "Name of the member; of a station: its id")->required();
  enrolled->add_option("--role", words.role, "station, fusion, operator, simulator, cue, listener")
      ->check(CLI::IsMember({"station", "fusion", "operator", "simulator", "cue", "listener"}))
      ->capture_default_str();
  auto* by_hex = enrolled->add_option("--public", words.public_key,
                                      "Public key that ols-key make has printed");
  enrolled->add_option("--key", words.key, "File for the new private key; else NAME.key")
      ->excludes(by_hex);
  add_root_and_list(*enrolled, words);
  auto* revoked = app.add_subcommand("revoke", "Take a member's key out of use");
  revoked->add_option("name", words.name, "Name of the member")->required();
  add_root_and_list(*revoked, words);
  std::int64_t above = 0;
  auto* set = add_settings(app, words, above);
  auto* listed = app.add_subcommand("list", "Show the list");
  listed->add_option("--list", words.list, "File of the trust list")->capture_default_str();
  listed->add_option("--root-public", words.root_public, "The root's public key, to be sure");
  auto* verified = app.add_subcommand("verify", "Verify every message of a recording");
  verified->add_option("log", words.log, "Log of ols-logger or lcm-logger")->required();
  verified->add_option("--lists", words.lists, "Folder of trust-*.toml; else the log's own");
  verified->add_option("--root-public", words.root_public, "The root's public key, to be sure");
  return ols::run_command(app, argc, argv, "ols-key", [&] {
    ::umask(022);  // services read the lists; keys are written for their owner alone
    int status = 0;
    if (*site) site_new(words);
    if (*invited) invite(words);
    if (*made) make(words, invitation);
    if (*enrolled) enrol(words);
    if (*revoked) revoke(words);
    if (*set) settings(words, above);
    if (*listed) list(words);
    if (*verified) status = verify(words);
    return status;
  });
}
