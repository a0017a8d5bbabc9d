#include "tools/setup/backup.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "base/config/configuration_files.h"
#include "base/process/command_output.h"
#include "base/trust/key_file.h"
#include "tools/setup/membership.h"
#include "tools/setup/never_older.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

constexpr double kPatience_s = 600.0;
constexpr std::string_view kEnabled = "etc/systemd/system/multi-user.target.wants/";
// Paths below the root; the last part may be the beginning of a name.
constexpr std::array<std::string_view, 10> kParts{
    "etc/ols/",
    "etc/credstore/ols-",
    "etc/chrony/conf.d/ols-",
    "etc/default/gpsd",
    "etc/systemd/system/ols-",  // drop-ins
    "etc/systemd/system/multi-user.target.wants/ols-",
    "etc/systemd/system/multi-user.target.wants/gpsd.",
    "etc/udev/rules.d/61-ols-site.rules",
    "var/lib/ols/calibration",
    "var/lib/ols-setup/"};
// The files here are persisted states. Other folders here are maps, exports, and what a person put
// there.
constexpr std::string_view kStates = "var/lib/ols/";

std::vector<std::string> present(const std::string& root) {
  std::vector<std::string> paths;
  const auto add = [&](const fs::path& folder, std::string_view beginning, bool files_alone) {
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(fs::path(root) / folder, missing)) {
      const std::string name = entry.path().filename();
      if (files_alone && !fs::is_regular_file(entry.symlink_status())) continue;
      if (name.starts_with(beginning)) paths.push_back(folder / name);
    }
  };
  for (const std::string_view part : kParts) {
    const fs::path pattern(part);
    const fs::path folder = pattern.parent_path();
    if (!pattern.filename().empty()) {
      add(folder, pattern.filename().native(), false);
    } else if (fs::exists(fs::path(root) / folder)) {
      paths.push_back(folder);
    }
  }
  // A regular file may have the name of a calibration, too.
  add(kStates, "", true);
  std::ranges::sort(paths);
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  return paths;
}

std::vector<std::string> members_of(const std::string& file) {
  constexpr std::size_t kMostNames = 100'000'000;  // [byte]: of a million files
  const auto listed =
      command_output({"tar", "--list", "--gzip", "--file", file}, kPatience_s, kMostNames);
  if (!listed) throw std::runtime_error(file + ": cannot be read as a backup");
  std::istringstream lines(*listed);
  std::vector<std::string> members;
  for (std::string line; std::getline(lines, line);) members.push_back(line);
  return members;
}

// The file of the time keys is not the site's alone, so no backup has it. The site's key is made
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
  if (member.starts_with(kStates)) return true;
  return std::ranges::any_of(kParts,
                             [&](std::string_view part) { return member.starts_with(part); });
}

std::vector<std::string> units_of(const std::vector<std::string>& members) {
  std::vector<std::string> enabled, configured;
  for (const std::string& member : members) {
    const fs::path path(member);
    if (member.starts_with(kEnabled)) enabled.push_back(path.filename());
    if (path.parent_path() != "etc/ols" || path.extension() != ".toml") continue;
    const std::string name = path.stem();
    if (is_station_file(name)) configured.push_back("ols-station@" + name + ".service");
    if (is_program_file(name)) configured.push_back("ols-" + name + ".service");
  }
  // Debian enables gpsd by itself, also where nothing of ours was.
  if (std::ranges::any_of(enabled, [](const auto& unit) { return unit.starts_with("ols-"); })) {
    return enabled;
  }
  if (!configured.empty())
    configured.insert(configured.begin(), {"ols-bus.service", "ols-time.service"});
  configured.insert(configured.begin(), enabled.begin(), enabled.end());
  return configured;
}

std::vector<std::string> restore(const Host& host, const std::string& file) {
  const std::vector<std::string> members = members_of(file);
  for (const std::string& member : members) {
    if (!is_of_backup(member)) throw std::runtime_error(file + ": holds " + member + ": no backup");
  }
  const NeverOlder present(host);
  const auto done = command_output({"tar", "--extract", "--gzip", "--preserve-permissions",
                                    "--file", file, "--directory", host.path("/")},
                                   kPatience_s);
  present.put_back();
  if (!done) throw std::runtime_error(file + ": not all could be restored");
  restore_time_key(host, members);
  return units_of(members);
}

}  // namespace ols::setup
