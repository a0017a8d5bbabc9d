#include "sim/gpio/gpio_socket.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <vector>

namespace ols::sim {
namespace {

int listen_at(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    throw std::system_error(ENAMETOOLONG, std::generic_category(), path);
  }
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  ::unlink(path.c_str());
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0 || ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::listen(fd, 8) != 0) {
    const int error = errno;
    if (fd >= 0) ::close(fd);
    throw std::system_error(error, std::generic_category(), path);
  }
  return fd;
}

}  // namespace

GpioServer::GpioServer(const GpioServerConfig& config)
    : config_(config),
      listener_(listen_at(config.path)),
      bell_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_([this](const std::stop_token& ended) { run(ended); }) {}

GpioServer::~GpioServer() {
  thread_ = {};  // asks it to end and joins
  for (const auto& [fd, pending] : clients_) ::close(fd);
  ::close(listener_);
  ::close(bell_);
  ::unlink(config_.path.c_str());
}

void GpioServer::run(const std::stop_token& ended) {
  const std::stop_callback wake(ended, [this] { ::eventfd_write(bell_, 1); });
  while (!ended.stop_requested()) {
    std::vector<pollfd> entries{{bell_, POLLIN, 0}, {listener_, POLLIN, 0}};
    {
      const std::lock_guard lock(mutex_);
      if (!silent_) {
        for (const auto& [fd, pending] : clients_) entries.push_back({fd, POLLIN, 0});
      }
    }
    ::poll(entries.data(), entries.size(), -1);
    const std::lock_guard lock(mutex_);
    if (entries[0].revents != 0) {
      eventfd_t rung;
      ::eventfd_read(bell_, &rung);
    }
    if (entries[1].revents != 0) greet();
    for (std::size_t i = 2; i < entries.size(); ++i) {
      if (entries[i].revents != 0) serve(entries[i].fd);
    }
  }
}

void GpioServer::greet() {
  const int fd = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (fd < 0) return;
  clients_[fd];
  if (silent_) return;
  tell(fd, config_.stop_line);
  tell(fd, config_.rearm_line);
}

void GpioServer::tell(int fd, int line) const {
  const bool high = line == config_.stop_line ? pressed_ != config_.stop_active_low
                                              : rearm_held_ != config_.rearm_active_low;
  const std::string text = "in " + std::to_string(line) + (high ? " 1\n" : " 0\n");
  // A client that does not read gets no more; the next poll finds closed ones.
  [[maybe_unused]] const ssize_t n = ::send(fd, text.data(), text.size(), MSG_NOSIGNAL);
}

void GpioServer::serve(int fd) {
  std::array<char, 512> buffer;
  const ssize_t n = ::recv(fd, buffer.data(), buffer.size(), 0);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
  bool good = n > 0;
  if (good) {
    std::string& pending = clients_[fd];
    pending.append(buffer.data(), static_cast<std::size_t>(n));
    std::size_t end;
    while (good && (end = pending.find('\n')) != std::string::npos) {
      good = obey(fd, pending.substr(0, end));
      pending.erase(0, end + 1);
    }
  }
  if (good) return;
  ::close(fd);
  clients_.erase(fd);
}

// False for a message that is not of the protocol.
bool GpioServer::obey(int fd, const std::string& text) {
  int line = -1, level = -1;
  char more = 0;
  if (std::sscanf(text.c_str(), "read %d%c", &line, &more) == 1) {
    if (line == config_.stop_line || line == config_.rearm_line) tell(fd, line);
    return true;
  }
  if (std::sscanf(text.c_str(), "out %d %d%c", &line, &level, &more) != 2) return false;
  const bool high = level != 0;
  if (line == config_.led_line && led_ != high) {
    led_ = high;
    ++led_changes_;
  }
  if (line == config_.trigger_line) {
    if (high && !trigger_) ++triggers_;
    trigger_ = high;
  }
  return true;
}

void GpioServer::set_pressed(bool pressed) {
  const std::lock_guard lock(mutex_);
  if (pressed_ == pressed) return;
  pressed_ = pressed;
  if (silent_) return;
  for (const auto& [fd, pending] : clients_) tell(fd, config_.stop_line);
}

void GpioServer::hold_rearm(bool held) {
  const std::lock_guard lock(mutex_);
  if (rearm_held_ == held) return;
  rearm_held_ = held;
  if (silent_) return;
  for (const auto& [fd, pending] : clients_) tell(fd, config_.rearm_line);
}

void GpioServer::set_silent(bool silent) {
  const std::lock_guard lock(mutex_);
  silent_ = silent;
  ::eventfd_write(bell_, 1);
}

bool GpioServer::led() const {
  const std::lock_guard lock(mutex_);
  return led_;
}

std::uint64_t GpioServer::led_changes() const {
  const std::lock_guard lock(mutex_);
  return led_changes_;
}

std::uint64_t GpioServer::triggers() const {
  const std::lock_guard lock(mutex_);
  return triggers_;
}

int GpioServer::clients() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(clients_.size());
}

}  // namespace ols::sim
