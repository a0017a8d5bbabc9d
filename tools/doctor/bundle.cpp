#include "tools/doctor/bundle.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "base/files/small_file.h"
#include "base/process/command_output.h"
#include "base/text/plain_text.h"
#include "tools/doctor/secrets.h"

namespace ols::doctor {
namespace {

namespace fs = std::filesystem;

constexpr double kPatience_s = 20.0;
constexpr std::size_t kLargestFile = 1'000'000;

struct Asked {
  const char* name;
  std::vector<std::string> command;
};

std::vector<Asked> commands() {
  return {{"journal.txt",
           {"journalctl", "--no-pager", "--since=-1d", "--lines=5000", "--unit=ols-*",
            "--unit=chrony", "--unit=gpsd"}},
          {"services.txt", {"systemctl", "list-units", "--all", "--no-pager", "ols-*"}},
          {"packages.txt", {"dpkg-query", "--show", "ols-*", "python3-ols", "chrony", "gpsd"}},
          {"kernel.txt", {"uname", "-a"}},
          {"clock.txt", {"chronyc", "-n", "tracking"}},
          {"sources.txt", {"chronyc", "-n", "sources", "-v"}},
          {"network.txt", {"ip", "-statistics", "address"}},
          {"routes.txt", {"ip", "route", "show", "table", "all"}},
          {"disks.txt", {"df", "-h"}},
          {"adapters.txt", {"ls", "-l", "/dev/serial/by-id", "/dev/ols"}}};
}

std::string line_without_secrets(const std::string& text) {
  std::string line = without_secrets(plain_text(text));
  if (!line.empty()) line.pop_back();  // its end
  return line;
}

// A temporary folder, which is removed with this object.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "ols-bundle-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  // The only ways into the folder: each removes secrets.
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << without_secrets(text);
  }
  void put_toml(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << without_secrets_of_toml(text);
  }
  // Each text by itself: in JSON, a line would lose its end with a secret.
  void put(const std::string& name, Findings findings) const {
    for (Finding& finding : findings) {
      finding.what = line_without_secrets(finding.what);
      finding.advice = line_without_secrets(finding.advice);
    }
    std::ofstream(path_ / name) << to_json(findings);
  }
  std::string path() const { return path_; }

 private:
  fs::path path_;
};

void put_configuration(const Folder& folder, const std::string& from) {
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(from, missing)) {
    const std::string extension = entry.path().extension();
    if (extension != ".toml" && extension != ".env" && extension != ".conf") continue;
    const std::string name = "configuration-" + entry.path().filename().string();
    try {
      const std::string text = read_small_file(entry.path(), kLargestFile);
      extension == ".toml" ? folder.put_toml(name, text) : folder.put(name, text);
    } catch (const std::exception& problem) {
      folder.put(name, problem.what());
    }
  }
}

}  // namespace

void write_bundle(const std::string& file, const BundleContents& contents) {
  const Folder folder;
  folder.put("doctor.json", contents.findings);
  folder.put("version.txt", contents.version);
  for (const auto& [name, command] : commands()) {
    folder.put(name, command_output(command, kPatience_s).value_or("cannot be asked"));
  }
  std::string statuses;  // in one file: a name that was heard may hold anything
  for (const auto& [station, status] : contents.statuses) statuses += status + "\n";
  folder.put("statuses.txt", statuses);
  put_configuration(folder, contents.configuration_folder);
  const auto packed = command_output(
      {"tar", "--create", "--gzip", "--file", file, "--directory", folder.path(), "."},
      kPatience_s);
  if (!packed) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace ols::doctor
