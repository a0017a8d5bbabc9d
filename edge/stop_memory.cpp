#include "edge/stop_memory.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace ols {

StopMemory::StopMemory(std::string file) : file_(std::move(file)) {
  std::error_code unreadable;
  const bool there = !file_.empty() && std::filesystem::exists(file_, unreadable);
  // Who cannot know whether he was stopped is stopped.
  pending_ = there || unreadable;
  if (unreadable) trouble_ = file_ + ": " + unreadable.message();
}

void StopMemory::set(bool pending) {
  if (pending == pending_) return;
  pending_ = pending;
  if (file_.empty()) return;
  int failed = 0;
  if (pending) {
    const int descriptor = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0640);
    failed = descriptor < 0 ? errno : 0;
    if (descriptor >= 0) ::close(descriptor);
  } else if (::unlink(file_.c_str()) != 0 && errno != ENOENT) {
    failed = errno;
  }
  trouble_ = failed == 0 ? "" : file_ + ": " + std::strerror(failed);
}

}  // namespace ols
