#include "export/outlet/file_link.h"

#include <poll.h>

#include <exception>

#include "base/files/atomic_file.h"

namespace ols::exports {

std::string file_name(const std::string& path, const std::string& where) {
  const auto slash = path.rfind('/');
  const auto dot = path.rfind('.');
  const bool has_end = dot != std::string::npos && (slash == std::string::npos || dot > slash + 1);
  const auto end = has_end ? dot : path.size();
  return path.substr(0, end) + where + path.substr(end);
}

void FileLink::open() {
  try {
    const AtomicFile attempt(path_);
  } catch (const std::exception& failure) {
    throw LinkError(failure.what());
  }
}

void FileLink::send(const Packet& packet) {
  try {
    AtomicFile file(file_name(path_, packet.where));
    file.stream() << packet.bytes;
    file.commit();
  } catch (const std::exception& failure) {
    throw LinkError(failure.what());
  }
}

void FileLink::wait(int wake_fd, double seconds) {
  pollfd wake{wake_fd, POLLIN, 0};
  ::poll(&wake, 1, static_cast<int>(1e3 * seconds));
}

}  // namespace ols::exports
