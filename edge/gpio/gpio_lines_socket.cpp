// Lines served over a Unix socket; the protocol stands in gpio_lines.h.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/clocks.h"
#include "edge/gpio/gpio_lines.h"

namespace ols {
namespace {

constexpr double kAnswer_s = 0.5;  // a server that takes longer is as good as gone
constexpr std::size_t kLongestLine = 64;
constexpr std::string_view kSocket = "socket:";

struct Message {
  int line;
  bool high;
};

// "in 17 1"
std::optional<Message> parse(std::string_view text) {
  if (!text.starts_with("in ")) return std::nullopt;
  text.remove_prefix(3);
  int line = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), line);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc{} || line < 0 || (rest != " 0" && rest != " 1")) return std::nullopt;
  return Message{line, rest == " 1"};
}

class SocketLines : public GpioLines {
 public:
  SocketLines(const std::string& path, const LineUse& use) : path_(path), input_(use.input) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) fail(ENAMETOOLONG, "is no socket");
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    fd_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (fd_ < 0) fail(errno, "no socket");
    try {
      if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        fail(errno, "cannot be connected");
      }
      for (const int line : use.outputs) write(line, false);
    } catch (...) {
      ::close(fd_);
      throw;
    }
  }
  ~SocketLines() override { ::close(fd_); }

  int fd() const override { return fd_; }

  std::vector<LineLevel> receive() override {
    std::array<char, 512> buffer;
    for (;;) {
      const ssize_t n = ::recv(fd_, buffer.data(), buffer.size(), 0);
      if (n > 0) {
        pending_.append(buffer.data(), static_cast<std::size_t>(n));
        if (pending_.size() > 64 * kLongestLine) break;  // the rest at the next call
      } else if (n == 0) {
        fail(EPIPE, "has been closed");
      } else if (errno == EAGAIN) {
        break;
      } else if (errno != EINTR) {
        fail(errno, "has vanished");
      }
    }
    return take_levels();
  }

  void refresh() override {
    if (input_ < 0) return;
    const double now_s = clock_monotonic_s();
    if (asked_s_ && now_s - *asked_s_ > kAnswer_s) fail(ETIMEDOUT, "does not answer");
    if (asked_s_) return;
    send("read " + std::to_string(input_) + "\n");
    asked_s_ = now_s;
  }

  void write(int line, bool high) override {
    send("out " + std::to_string(line) + (high ? " 1\n" : " 0\n"));
  }

 private:
  std::vector<LineLevel> take_levels() {
    std::vector<LineLevel> levels;
    std::size_t end;
    while ((end = pending_.find('\n')) != std::string::npos) {
      const auto message = parse(std::string_view(pending_).substr(0, end));
      if (!message) fail(EPROTO, "sends what is no level");
      pending_.erase(0, end + 1);
      if (message->line != input_) continue;
      asked_s_.reset();
      levels.push_back({message->high, clock_monotonic_s()});
    }
    if (pending_.size() > kLongestLine) fail(EPROTO, "sends what is no level");
    return levels;
  }

  void send(const std::string& text) {
    // A server that lets a full buffer stand has stopped reading.
    const ssize_t n = ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL);
    if (n != static_cast<ssize_t>(text.size())) fail(n < 0 ? errno : EAGAIN, "cannot be written");
  }

  [[noreturn]] void fail(int error, const char* what) const {
    throw std::system_error(error, std::generic_category(),
                            std::string(kSocket) + path_ + ": " + what);
  }

  std::string path_;
  int input_;
  int fd_ = -1;
  std::string pending_;
  std::optional<double> asked_s_;  // since when an answer is due
};

}  // namespace

std::unique_ptr<GpioLines> open_socket_lines(const std::string& path, const LineUse& use) {
  return std::make_unique<SocketLines>(path, use);
}

std::unique_ptr<GpioLines> open_gpio_lines(const std::string& chip, const LineUse& use) {
  if (chip.starts_with(kSocket)) return open_socket_lines(chip.substr(kSocket.size()), use);
  return open_chip_lines(chip, use);
}

}  // namespace ols
