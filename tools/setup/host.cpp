#include "tools/setup/host.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "tools/setup/kept_file.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 1'000'000;
constexpr const char* kRecords = "/var/lib/ols-setup";  // what was written last
constexpr std::string_view kUnit = "ols-", kStationUnit = "ols-station@";

std::optional<std::string> text_if_any(const std::string& path) {
  if (!fs::exists(path)) return std::nullopt;
  return read_small_file(path, kLargestFile);
}

void replace(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

std::string record_name(std::string path) {
  std::ranges::replace(path, '/', '-');
  return path.substr(1);
}

}  // namespace

std::string Host::folder(const std::string& path, unsigned mode) const {
  const std::string there = root_ + path;
  if (fs::exists(there)) return there;
  fs::create_directories(there);
  fs::permissions(there, static_cast<fs::perms>(mode));
  return there;
}

std::vector<std::string> Host::write(const std::vector<PlannedFile>& files) const {
  std::vector<std::string> changed;
  const std::string records = folder(kRecords, 0700);
  for (const PlannedFile& file : files) {
    const std::string there = path(file.path);
    const std::string record = records + "/" + record_name(file.path);
    const auto present = text_if_any(there);
    auto last = text_if_any(record);
    const bool unchosen =
        present && !file.unchosen.empty() && present->find(file.unchosen) != std::string::npos;
    if (!last && unchosen) last = present;
    const Rewrite now =
        file.is_toml ? rewrite(present, last, file.text) : rewrite_whole(present, last, file.text);
    if (now.text) {
      folder(fs::path(file.path).parent_path(), 0755);
      replace(there, *now.text);
      changed.push_back(file.path);
    }
    // Only if the file is in place by now: otherwise the next run would find nothing to change.
    if (now.text || last) replace(record, file.text);
    std::printf("%s: %s\n", there.c_str(), now.note.c_str());
  }
  return changed;
}

int run(const std::vector<std::string>& command) {
  std::fflush(stdout);
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  pid_t process = 0;
  if (::posix_spawnp(&process, words.front(), nullptr, nullptr, words.data(), environ) != 0) {
    return -1;
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  // POSIX: where posix_spawn cannot return why the program did not start, as under emulation, the
  // child ends with 127.
  constexpr int kNotStarted = 127;
  return WIFEXITED(status) && WEXITSTATUS(status) != kNotStarted ? WEXITSTATUS(status) : -1;
}

std::vector<std::string> start(const std::vector<std::string>& units) {
  run({"systemctl", "daemon-reload"});
  std::vector<std::string> failed;
  // One by one: if one of several is not installed, systemctl starts none of them.
  for (const std::string& unit : units) {
    if (run({"systemctl", "enable", "--now", unit}) != 0) failed.push_back(unit);
  }
  run({"systemctl", "try-restart", "chrony.service", "gpsd.service"});
  return failed;
}

std::vector<std::string> running(const std::vector<std::string>& units) {
  std::vector<std::string> found = units;
  std::erase_if(found, [](const std::string& unit) {
    return run({"systemctl", "is-active", "--quiet", unit}) != 0;
  });
  return found;
}

std::vector<std::string> readers(const std::vector<std::string>& units,
                                 const std::vector<std::string>& changed) {
  const auto reads = [&](const std::string& unit) {
    const bool is_station = unit.starts_with(kStationUnit);
    std::string name = unit.substr(is_station ? kStationUnit.size() : kUnit.size());
    name = name.substr(0, name.rfind(".service"));
    return std::ranges::any_of(changed, [&](const std::string& path) {
      return path == "/etc/ols/bus.env" || path == "/etc/ols/" + name + ".toml" ||
             path == "/etc/credstore/ols-" + name + ".key";
    });
  };
  std::vector<std::string> found;
  for (const std::string& unit : units) {
    if (unit.starts_with(kUnit) && reads(unit)) found.push_back(unit);
  }
  return found;
}

std::string trouble(const std::vector<std::string>& not_started, int doctor) {
  constexpr int kFailures = 2;
  std::string text;
  for (const std::string& unit : not_started) text += (text.empty() ? "" : ", ") + unit;
  if (!text.empty()) text = "not started: " + text;
  if (doctor >= 0 && doctor < kFailures) return text;
  if (!text.empty()) text += "; ";
  return text + (doctor == kFailures ? "ols-doctor finds failures" : "ols-doctor cannot run");
}

}  // namespace ols::setup
