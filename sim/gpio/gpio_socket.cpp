#include "sim/gpio/gpio_socket.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <map>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <thread>
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

struct GpioServer::Impl {
  explicit Impl(const GpioServerConfig& server_config)
      : config(server_config), listener(listen_at(config.path)) {}
  ~Impl() {
    thread = {};  // asks it to end and joins
    for (const auto& [fd, pending] : clients) ::close(fd);
    ::close(listener);
    ::close(bell);
    ::unlink(config.path.c_str());
  }

  void run(const std::stop_token& ended) {
    const std::stop_callback wake(ended, [this] { ::eventfd_write(bell, 1); });
    while (!ended.stop_requested()) {
      std::vector<pollfd> entries{{bell, POLLIN, 0}, {listener, POLLIN, 0}};
      {
        const std::lock_guard lock(mutex);
        if (!silent) {
          for (const auto& [fd, pending] : clients) entries.push_back({fd, POLLIN, 0});
        }
      }
      ::poll(entries.data(), entries.size(), -1);
      const std::lock_guard lock(mutex);
      if (entries[0].revents != 0) {
        eventfd_t rung;
        ::eventfd_read(bell, &rung);
      }
      if (entries[1].revents != 0) greet();
      for (std::size_t i = 2; i < entries.size(); ++i) {
        if (entries[i].revents != 0) serve(entries[i].fd);
      }
    }
  }

  void greet() {
    const int fd = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) return;
    clients[fd];
    if (silent) return;
    tell(fd, config.stop_line);
    tell(fd, config.rearm_line);
  }

  void tell(int fd, int line) const {
    const bool high = line == config.stop_line ? pressed != config.stop_active_low
                                               : rearm_held != config.rearm_active_low;
    const std::string text = "in " + std::to_string(line) + (high ? " 1\n" : " 0\n");
    // A client that does not read gets no more; the next poll finds closed ones.
    [[maybe_unused]] const ssize_t n = ::send(fd, text.data(), text.size(), MSG_NOSIGNAL);
  }

  void serve(int fd) {
    std::array<char, 512> buffer;
    const ssize_t n = ::recv(fd, buffer.data(), buffer.size(), 0);
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) return;
    bool good = n > 0;
    if (good) {
      std::string& pending = clients[fd];
      pending.append(buffer.data(), static_cast<std::size_t>(n));
      std::size_t end;
      while (good && (end = pending.find('\n')) != std::string::npos) {
        good = obey(fd, pending.substr(0, end));
        pending.erase(0, end + 1);
      }
    }
    if (good) return;
    ::close(fd);
    clients.erase(fd);
  }

  // False for a message that is not of the protocol.
  bool obey(int fd, const std::string& text) {
    int line = -1, level = -1;
    char more = 0;
    if (std::sscanf(text.c_str(), "read %d%c", &line, &more) == 1) {
      if (line == config.stop_line || line == config.rearm_line) tell(fd, line);
      return true;
    }
    if (std::sscanf(text.c_str(), "out %d %d%c", &line, &level, &more) != 2) return false;
    const bool high = level != 0;
    if (line == config.led_line && led != high) {
      led = high;
      ++led_changes;
    }
    if (line == config.trigger_line) {
      if (high && !trigger) ++triggers;
      trigger = high;
    }
    return true;
  }

  const GpioServerConfig config;
  const int listener;
  const int bell = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);

  mutable std::mutex mutex;            // for everything below
  std::map<int, std::string> clients;  // the unfinished line of each
  bool pressed = false, rearm_held = false, silent = false;
  bool led = false, trigger = false;
  std::uint64_t led_changes = 0, triggers = 0;
  std::jthread thread;
};

GpioServer::GpioServer(const GpioServerConfig& config) : impl_(std::make_unique<Impl>(config)) {
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& t) { impl->run(t); });
}

GpioServer::~GpioServer() = default;

void GpioServer::set_pressed(bool pressed) {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->pressed == pressed) return;
  impl_->pressed = pressed;
  if (impl_->silent) return;
  for (const auto& [fd, pending] : impl_->clients) impl_->tell(fd, impl_->config.stop_line);
}

void GpioServer::hold_rearm(bool held) {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->rearm_held == held) return;
  impl_->rearm_held = held;
  if (impl_->silent) return;
  for (const auto& [fd, pending] : impl_->clients) impl_->tell(fd, impl_->config.rearm_line);
}

void GpioServer::set_silent(bool silent) {
  const std::lock_guard lock(impl_->mutex);
  impl_->silent = silent;
  ::eventfd_write(impl_->bell, 1);
}

bool GpioServer::led() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->led;
}

std::uint64_t GpioServer::led_changes() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->led_changes;
}

std::uint64_t GpioServer::triggers() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->triggers;
}

int GpioServer::clients() const {
  const std::lock_guard lock(impl_->mutex);
  return static_cast<int>(impl_->clients.size());
}

}  // namespace ols::sim
