#include "tools/setup/never_older.h"

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "tools/setup/flat_toml.h"

namespace ols::setup {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = 20'000'000;

bool is_marks(const fs::path& file) { return file.filename().native().starts_with("heard-"); }

bool has_number(const fs::path& file) {
  const std::string name = file.filename();
  return name == "trust.toml" || name == "site.toml" ||
         (file.extension() == ".toml" && (name.starts_with("trust-") || name.starts_with("site-")));
}

// 0: it has none, or cannot be read.
std::int64_t number_in(const std::string& text) {
  std::int64_t number = 0;
  try {
    const Values values = flat(text);
    if (const std::string* value = find(values, "number")) {
      std::from_chars(value->data(), value->data() + value->size(), number);
    }
  } catch (const std::runtime_error&) {
    return 0;
  }
  return number;
}

}  // namespace

NeverOlder::NeverOlder(const Host& host) {
  for (const char* folder : {"/etc/ols", "/var/lib/ols"}) {
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(host.path(folder), missing)) {
      if (!fs::is_regular_file(entry.symlink_status())) continue;
      if (!has_number(entry.path()) && !is_marks(entry.path())) continue;
      files_.push_back({entry.path(), read_small_file(entry.path(), kLargestFile)});
    }
  }
}

void NeverOlder::put_back() const {
  for (const File& file : files_) {
    const std::string now = fs::exists(file.path) ? read_small_file(file.path, kLargestFile) : "";
    if (now == file.text) continue;
    if (!is_marks(file.path) && number_in(now) >= number_in(file.text)) continue;
    AtomicFile there(file.path);
    there.stream() << file.text;
    there.commit();
    std::printf("%s: kept, it is newer than the backup's\n", file.path.c_str());
  }
}

}  // namespace ols::setup
