#include "base/atomic_file.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace ols {
namespace {

std::system_error file_error(const std::string& path) {
  return {errno == 0 ? EIO : errno, std::generic_category(), path};
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path)
    : path_(path), temporary_(path + ".partial"), stream_(temporary_) {
  if (!stream_) throw file_error(temporary_);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  stream_.close();
  if (!stream_) throw file_error(temporary_);
  std::filesystem::rename(temporary_, path_);
  committed_ = true;
}

}  // namespace ols
