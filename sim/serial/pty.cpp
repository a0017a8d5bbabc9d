#include "sim/serial/pty.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace ols::sim {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

std::string slave_name(int master) {
  std::array<char, 128> name{};
  if (::grantpt(master) != 0 || ::unlockpt(master) != 0) fail("pty");
  if (::ptsname_r(master, name.data(), name.size()) != 0) fail("pty");
  return name.data();
}

void make_raw(int slave) {
  termios settings{};
  if (::tcgetattr(slave, &settings) != 0) fail("pty");
  ::cfmakeraw(&settings);
  if (::tcsetattr(slave, TCSANOW, &settings) != 0) fail("pty");
}

timespec to_timespec(double duration_s) {
  const double whole_s = std::floor(std::max(0.0, duration_s));
  return {static_cast<time_t>(whole_s), static_cast<long>((duration_s - whole_s) * 1e9)};
}

struct Rate {
  speed_t code;
  int baud;
};

constexpr std::array<Rate, 9> kRates{{{B600, 600},
                                      {B1200, 1200},
                                      {B2400, 2400},
                                      {B4800, 4800},
                                      {B9600, 9600},
                                      {B19200, 19200},
                                      {B38400, 38400},
                                      {B57600, 57600},
                                      {B115200, 115200}}};

}  // namespace

struct Pty::Terminal {
  explicit Terminal(const std::string& link_path)
      : master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)),
        device(slave_name(master.get())),
        slave(::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)),
        link(link_path) {
    if (slave.get() < 0) fail(device);
    make_raw(slave.get());
    if (link.empty()) return;
    if (std::filesystem::is_symlink(link)) std::filesystem::remove(link);
    std::filesystem::create_symlink(device, link);
  }

  // Another process may have replaced the link.
  ~Terminal() {
    std::error_code ignored;
    if (!link.empty() && std::filesystem::read_symlink(link, ignored) == device) {
      std::filesystem::remove(link, ignored);
    }
  }

  Descriptor master;
  std::string device;
  Descriptor slave;  // held open, so that a client that leaves does not hang up the line
  std::string link;
};

Pty::Pty(const std::string& link) : link_(link) { plug(); }

Pty::~Pty() = default;

Pty::Pty(Pty&&) noexcept = default;

const std::string& Pty::device() const {
  static const std::string kNone;
  return terminal_ ? terminal_->device : kNone;
}

void Pty::unplug() { terminal_.reset(); }

void Pty::plug() {
  if (!terminal_) terminal_ = std::make_unique<Terminal>(link_);
}

bool Pty::plugged() const { return terminal_ != nullptr; }

void Pty::wait(double timeout_s) const {
  pollfd entry{terminal_ ? terminal_->master.get() : -1, POLLIN, 0};
  const timespec timeout = to_timespec(timeout_s);
  ::ppoll(&entry, 1, &timeout, nullptr);
}

std::string Pty::read() {
  std::array<char, 512> buffer;
  const ssize_t n =
      terminal_ ? ::read(terminal_->master.get(), buffer.data(), buffer.size()) : ssize_t{0};
  return n > 0 ? std::string(buffer.data(), static_cast<std::size_t>(n)) : std::string();
}

int Pty::client_baud() const {
  termios settings{};
  if (!terminal_ || ::tcgetattr(terminal_->master.get(), &settings) != 0) return 0;
  const speed_t code = ::cfgetospeed(&settings);
  const auto rate =
      std::find_if(kRates.begin(), kRates.end(), [code](const Rate& r) { return r.code == code; });
  return rate == kRates.end() ? 0 : rate->baud;
}

void Pty::write(std::string_view bytes) {
  if (!terminal_ || bytes.empty()) return;
  static_cast<void>(!::write(terminal_->master.get(), bytes.data(), bytes.size()));
}

}  // namespace ols::sim
