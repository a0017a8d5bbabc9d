#include "base/process/status_file.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

#include "base/files/atomic_file.h"

namespace ols {

StatusFile::StatusFile(std::string path) : path_(std::move(path)) {}

void StatusFile::write(const std::string& text) {
  if (path_.empty()) return;
  try {
    AtomicFile file(path_);
    file.stream() << text << '\n';
    file.commit();
    is_reported_ = false;
  } catch (const std::exception& failure) {
    if (!is_reported_) spdlog::warn("status: {}", failure.what());
    is_reported_ = true;
  }
}

}  // namespace ols
