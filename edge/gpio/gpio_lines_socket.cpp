// Lines served over a Unix socket; gpio_lines.h has the protocol.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <map>
#include <string_view>
#include <system_error>

#include "base/process/clocks.h"
#include "edge/gpio/gpio_lines.h"
#include "edge/gpio/line_protocol.h"

namespace ols::gpio {
namespace {

constexpr double kAnswer_s = 0.5;  // a slower server counts as failed
constexpr std::size_t kMostAtOnce = 4096;
constexpr std::string_view kSocket = "socket:";

std::vector<int> lines_of(const std::vector<LineInput>& inputs) {
  std::vector<int> lines;
  for (const LineInput& input : inputs) lines.push_back(input.line);
  return lines;
}

class SocketLines : public GpioLines {
 public:
  SocketLines(const std::string& path, const LineUse& use)
      : path_(path), inputs_(lines_of(use.inputs)), protocol_(inputs_) {
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

  std::vector<int> fds() const override { return {fd_}; }

  std::vector<LineLevel> receive() override {
    std::array<char, kMostAtOnce> buffer;
    std::vector<LineLevel> levels;
    ssize_t n = 0;
    do {
      n = ::recv(fd_, buffer.data(), buffer.size(), 0);
    } while (n < 0 && errno == EINTR);
    if (n == 0) fail(EPIPE, "has been closed");
    if (n < 0 && errno != EAGAIN) fail(errno, "has vanished");
    if (n <= 0) return levels;
    const auto heard = protocol_.receive({buffer.data(), static_cast<std::size_t>(n)});
    if (!heard) fail(EPROTO, "sent something that is not a level");
    for (const LineProtocol::Level& level : *heard) {
      levels.push_back({level.line, level.high, clock_monotonic_s()});
      asked_s_.erase(level.line);
    }
    return levels;
  }

  void refresh() override {
    const double now_s = clock_monotonic_s();
    for (const int input : inputs_) {
      const auto asked = asked_s_.find(input);
      if (asked == asked_s_.end()) {
        send("read " + std::to_string(input) + "\n");
        asked_s_[input] = now_s;
      } else if (now_s - asked->second > kAnswer_s) {
        fail(ETIMEDOUT, "does not answer");
      }
    }
  }

  void write(int line, bool high) override {
    send("out " + std::to_string(line) + (high ? " 1\n" : " 0\n"));
  }

 private:
  void send(const std::string& text) {
    // A full buffer means that the server has stopped reading.
    const ssize_t n = ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL);
    if (n != static_cast<ssize_t>(text.size())) fail(n < 0 ? errno : EAGAIN, "cannot be written");
  }

  [[noreturn]] void fail(int error, const char* what) const {
    throw std::system_error(error, std::generic_category(),
                            std::string(kSocket) + path_ + ": " + what);
  }

  std::string path_;
  std::vector<int> inputs_;
  int fd_ = -1;
  LineProtocol protocol_;
  std::map<int, double> asked_s_;  // by line: since when an answer is due
};

}  // namespace

std::unique_ptr<GpioLines> open_socket_lines(const std::string& path, const LineUse& use) {
  return std::make_unique<SocketLines>(path, use);
}

std::unique_ptr<GpioLines> open_gpio_lines(const std::string& chip, const LineUse& use) {
  if (chip.starts_with(kSocket)) return open_socket_lines(chip.substr(kSocket.size()), use);
  return open_chip_lines(chip, use);
}

}  // namespace ols::gpio
