#include "tools/setup/backup.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/configuration_files.h"
#include "base/trust/key_file.h"
#include "edge/clock/command_output.h"
#include "tools/setup/membership.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

constexpr double kPatience_s = 600.0;
// Below the root. Of a pattern's last part only the beginning is given.
constexpr std::array<std::string_view, 7> kParts{"etc/ols/",
                                                 "etc/credstore/ols-",
                                                 "etc/chrony/conf.d/ols-",
                                                 "etc/default/gpsd",
                                                 "etc/udev/rules.d/61-ols-site.rules",
                                                 "var/lib/ols/",
                                                 "var/lib/ols-setup/"};

std::vector<std::string> present(const std::string& root) {
  std::vector<std::string> paths;
  for (const std::string_view part : kParts) {
    const fs::path pattern(part);
    const std::string beginning = pattern.filename();
    const fs::path folder = pattern.parent_path();
    if (beginning.empty()) {
      if (fs::exists(fs::path(root) / folder)) paths.push_back(folder);
      continue;
    }
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(fs::path(root) / folder, missing)) {
      const std::string name = entry.path().filename();
      if (name.starts_with(beginning)) paths.push_back(folder / name);
    }
  }
  return paths;
}

std::vector<std::string> members_of(const std::string& file) {
  constexpr std::size_t kMostNames = 100'000'000;  // [byte]: of a million files
  const auto listed =
      clock::command_output({"tar", "--list", "--gzip", "--file", file}, kPatience_s, kMostNames);
  if (!listed) throw std::runtime_error(file + ": cannot be read as a backup");
  std::istringstream lines(*listed);
  std::vector<std::string> members;
  for (std::string line; std::getline(lines, line);) members.push_back(line);
  return members;
}

// The file with the time's keys is not the site's alone, so it is in no backup: the site's is made
// again, from a member's key.
void restore_time_key(const Host& host, const std::vector<std::string>& members) {
  for (const std::string& member : members) {
    if (!member.starts_with("etc/credstore/") || !member.ends_with(".key")) continue;
    keep_time(host, trust::read_member_key(host.path("/" + member)).site_key);
    return;
  }
}

}  // namespace

void back_up(const Host& host, const std::string& file) {
  if (fs::exists(file)) throw std::runtime_error(file + ": is there already");
  const std::string root = host.path("/");
  const std::vector<std::string> paths = present(root);
  if (paths.empty()) throw std::runtime_error("nothing is configured here");
  std::vector<std::string> command{"tar",          "--create",    "--gzip", "--file",
                                   file + ".part", "--directory", root,     "--"};
  command.insert(command.end(), paths.begin(), paths.end());
  const mode_t before = ::umask(0077);
  // 1: a folder changed while it was read, as those of running services do; the archive is whole.
  const int status = run(command);
  ::umask(before);
  if (status != 0 && status != 1) {
    std::error_code ignored;
    fs::remove(file + ".part", ignored);  // it holds keys
    throw std::runtime_error(file + ": cannot be written");
  }
  fs::rename(file + ".part", file);
}

bool is_of_backup(const std::string& member) {
  if (member.find("..") != std::string::npos) return false;
  return std::ranges::any_of(kParts,
                             [&](std::string_view part) { return member.starts_with(part); });
}

std::vector<std::string> units_of(const std::vector<std::string>& members) {
  std::vector<std::string> units;
  for (const std::string& member : members) {
    const fs::path path(member);
    if (path.parent_path() != "etc/ols" || path.extension() != ".toml") continue;
    const std::string name = path.stem();
    if (is_station_file(name)) units.push_back("ols-station@" + name + ".service");
    if (is_program_file(name)) units.push_back("ols-" + name + ".service");
  }
  if (!units.empty()) units.insert(units.begin(), {"ols-bus.service", "ols-time.service"});
  return units;
}

void restore(const Host& host, const std::string& file) {
  const std::vector<std::string> members = members_of(file);
  for (const std::string& member : members) {
    if (!is_of_backup(member)) throw std::runtime_error(file + ": holds " + member + ": no backup");
  }
  const auto done = clock::command_output({"tar", "--extract", "--gzip", "--preserve-permissions",
                                           "--file", file, "--directory", host.path("/")},
                                          kPatience_s);
  if (!done) throw std::runtime_error(file + ": not all could be restored");
  restore_time_key(host, members);
  const std::vector<std::string> units = units_of(members);
  if (!host.is_this_host() || units.empty()) return;
  std::vector<std::string> enable{"systemctl", "enable", "--now"};
  enable.insert(enable.end(), units.begin(), units.end());
  const int enabled = run(enable);
  read_anew();
  if (enabled != 0) throw std::runtime_error("not all services have started: ols-doctor says why");
}

}  // namespace ols::setup
