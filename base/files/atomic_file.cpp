#include "base/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <system_error>

namespace ols {
namespace {

namespace fs = std::filesystem;

std::system_error file_error(const std::string& path) {
  return {errno == 0 ? EIO : errno, std::generic_category(), path};
}

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

// The final target of symbolic links, even if it does not exist yet.
std::string link_target(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the kernel
  std::error_code none;
  fs::path target = path;
  for (int links = 0; fs::is_symlink(target, none); ++links) {
    if (links == kMostLinks) throw std::system_error(ELOOP, std::generic_category(), path);
    target = target.parent_path() / fs::read_symlink(target);
  }
  return target.string();
}

// Refuses devices and pipes: a file would replace them.
std::string replaceable(const std::string& path) {
  std::error_code none;
  if (fs::exists(path, none) && !fs::is_regular_file(path, none)) {
    throw std::system_error(EINVAL, std::generic_category(), path + ": is not a plain file");
  }
  return link_target(path);
}

// Replacing a file's content must not change its owner and permissions.
void keep_owner_and_mode(const std::string& old_path, const std::string& new_path) {
  constexpr mode_t kPermissions = 07777;
  struct stat old {};
  if (::stat(old_path.c_str(), &old) != 0) return;
  // Without the right to change the owner, the file keeps the writer's.
  static_cast<void>(!::chown(new_path.c_str(), old.st_uid, old.st_gid));
  static_cast<void>(::chmod(new_path.c_str(), old.st_mode & kPermissions));
}

// Read by a signal handler. Without a free entry, only its destructor removes a file.
std::array<std::atomic<const char*>, 16> temporary_files;
static_assert(std::atomic<const char*>::is_always_lock_free);

void remove_temporary_files(int signal) {
  for (const auto& path : temporary_files) {
    if (const char* name = path.load()) ::unlink(name);
  }
  ::raise(signal);  // its handler was reset: this ends the program
}

}  // namespace

AtomicFile::Listed::Listed(const char* path) : path_(path) {
  for (auto& entry : temporary_files) {
    const char* none = nullptr;
    if (entry.compare_exchange_strong(none, path)) return;
  }
}

AtomicFile::Listed::~Listed() {
  for (auto& entry : temporary_files) {
    const char* mine = path_;
    if (entry.compare_exchange_strong(mine, nullptr)) return;
  }
}

AtomicFile::AtomicFile(const std::string& path)
    : path_(replaceable(path)),
      temporary_(path_ + ".partial"),
      listed_(temporary_.c_str()),
      stream_(temporary_) {
  if (!stream_) throw file_error(temporary_);
  keep_owner_and_mode(path_, temporary_);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  stream_.close();
  if (!stream_) throw file_error(temporary_);
  sync(temporary_);
  fs::rename(temporary_, path_);
  committed_ = true;
  const fs::path folder = fs::path(path_).parent_path();
  sync(folder.empty() ? "." : folder.string());
}

void remove_temporary_files_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    // A signal that the caller ignores (nohup) stays ignored.
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = remove_temporary_files;
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace ols
