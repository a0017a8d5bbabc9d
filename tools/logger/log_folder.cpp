#include "tools/logger/log_folder.h"

#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <tuple>

namespace ols::logger {

namespace fs = std::filesystem;

LogFolder::LogFolder(const std::string& folder, const std::string& name)
    : folder_(fs::path(folder).lexically_normal().string()), name_(name) {}

void LogFolder::survey() {
  fs::create_directories(folder_);
  if (::access(folder_.c_str(), W_OK | X_OK) != 0) {
    throw std::system_error(errno, std::generic_category(), folder_);
  }
  files_.clear();
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(name_ + "-") || file.find(".lcmlog.") == std::string::npos) continue;
    struct stat status {};
    if (::lstat(entry.path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    files_.push_back(
        {entry.path().string(), static_cast<double>(status.st_size),
         std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec});
  }
  std::ranges::sort(files_, {}, [](const LogFile& f) { return std::tuple(f.modified_ns, f.path); });
  measure_room();
}

void LogFolder::measure_room() {
  struct statvfs disk {};
  if (::statvfs(folder_.c_str(), &disk) != 0) {
    throw std::system_error(errno, std::generic_category(), folder_);
  }
  free_bytes_ = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
}

void LogFolder::remove_oldest(double quota_bytes, double reserve_bytes, double headroom_bytes,
                              const std::string& keep) {
  // Compares files, not paths: the writer may spell the folder differently.
  const std::string kept = keep.empty() ? "" : fs::path(keep).lexically_normal().string();
  auto oldest = files_.begin();
  while (bytes() + headroom_bytes > quota_bytes || free_bytes_ < reserve_bytes + headroom_bytes) {
    while (oldest != files_.end() && oldest->path == kept) ++oldest;
    if (oldest == files_.end()) return;
    if (::unlink(oldest->path.c_str()) != 0 && errno != ENOENT) {
      throw std::system_error(errno, std::generic_category(), oldest->path);
    }
    oldest = files_.erase(oldest);
    ++removed_;
    measure_room();
  }
}

double LogFolder::bytes() const {
  double sum = 0.0;
  for (const LogFile& file : files_) sum += file.bytes;
  return sum;
}

}  // namespace ols::logger
