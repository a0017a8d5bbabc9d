#include "base/files/output_check.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace ols {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code missing;
  if (fs::equivalent(a, b, missing)) return true;
  // An output that does not exist yet.
  return fs::weakly_canonical(a, missing) == fs::weakly_canonical(b, missing);
}

}  // namespace

void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  std::vector<NamedFile> taken = inputs;
  for (const NamedFile& output : outputs) {
    for (const NamedFile& other : taken) {
      if (!same_file(output.path, other.path)) continue;
      throw std::invalid_argument(output.option + ": " + output.path + " is the same file as " +
                                  other.option + " " + other.path);
    }
    taken.push_back(output);
  }
}

}  // namespace ols
