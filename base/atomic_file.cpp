#include "base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace ols {
namespace {

std::system_error file_error(const std::string& path) {
  return {errno == 0 ? EIO : errno, std::generic_category(), path};
}

// What the kernel still holds of a file or a folder goes to the disk.
void sync(const std::string& path) {
  errno = 0;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw file_error(path);
  const int failed = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  errno = failed;
  // Some file systems have nothing to sync.
  if (failed != 0 && failed != EINVAL && failed != EROFS) throw file_error(path);
}

// A device or a pipe would be replaced by a file.
const std::string& replaceable(const std::string& path) {
  std::error_code none;
  if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none)) {
    throw std::system_error(EINVAL, std::generic_category(), path + ": is not a plain file");
  }
  return path;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path)
    : path_(replaceable(path)), temporary_(path + ".partial"), stream_(temporary_) {
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
  sync(temporary_);
  std::filesystem::rename(temporary_, path_);
  committed_ = true;
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  sync(folder.empty() ? "." : folder.string());
}

}  // namespace ols
