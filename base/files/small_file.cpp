#include "base/files/small_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace ols {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

std::string read_small_file(const std::string& path, std::size_t most_bytes) {
  const auto failure = [&path](int why) {
    return std::system_error(why, std::generic_category(), path);
  };
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (file.number() < 0) throw failure(errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) throw failure(errno);
  if (S_ISDIR(status.st_mode)) throw failure(EISDIR);
  if (!S_ISREG(status.st_mode)) throw failure(EINVAL);
  std::string content(most_bytes + 1, '\0');
  std::size_t size = 0;
  while (size < content.size()) {
    const ssize_t bytes = ::read(file.number(), content.data() + size, content.size() - size);
    if (bytes < 0 && errno == EINTR) continue;
    if (bytes < 0) throw failure(errno);
    if (bytes == 0) break;
    size += static_cast<std::size_t>(bytes);
  }
  if (size > most_bytes) throw failure(EFBIG);
  content.resize(size);
  content.shrink_to_fit();  // many may be kept
  return content;
}

}  // namespace ols
