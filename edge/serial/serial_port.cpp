#include "edge/serial/serial_port.h"

#include <fcntl.h>
#include <linux/serial.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <system_error>

namespace ols::serial {

namespace {

constexpr double kMaxWrite_s = 0.2;

struct Rate {
  int baud;
  speed_t code;
};

constexpr std::array<Rate, 9> kRates{{{600, B600},
                                      {1200, B1200},
                                      {2400, B2400},
                                      {4800, B4800},
                                      {9600, B9600},
                                      {19200, B19200},
                                      {38400, B38400},
                                      {57600, B57600},
                                      {115200, B115200}}};

// USB adapters hold bytes back for up to 16 ms unless told otherwise. Not every device supports
// this.
void ask_for_low_latency(int fd) {
  serial_struct serial{};
  if (::ioctl(fd, TIOCGSERIAL, &serial) != 0) return;
  serial.flags |= ASYNC_LOW_LATENCY;
  ::ioctl(fd, TIOCSSERIAL, &serial);
}

}  // namespace

SerialPort::SerialPort(const std::string& device, int baud, Parity parity, const Wakeup* wakeup)
    : device_(device), wakeup_(wakeup) {
  fd_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) fail(errno, "cannot be opened");
  try {
    configure(baud, parity);
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

SerialPort::~SerialPort() { ::close(fd_); }

void SerialPort::fail(int error, const char* what) const {
  throw std::system_error(error, std::generic_category(), device_ + ": " + what);
}

void SerialPort::configure(int baud, Parity parity) {
  // A lock rather than TIOCEXCL, which outlives us on a pty that others hold open.
  if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) fail(errno, "is in use");
  termios settings{};
  if (::tcgetattr(fd_, &settings) != 0) fail(errno, "is not a serial device");
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | PARENB | PARODD | CRTSCTS);
  if (parity == Parity::kEven) {
    settings.c_cflag |= PARENB;
    settings.c_iflag |= INPCK;  // a byte of wrong parity is read as 0, which no protocol has
  }
  settings.c_cc[VMIN] = 1;  // so that a read of nothing means a hang-up
  settings.c_cc[VTIME] = 0;
  if (::tcsetattr(fd_, TCSANOW, &settings) != 0) fail(errno, "cannot be configured");
  set_rate(baud);
  ask_for_low_latency(fd_);
  ::tcflush(fd_, TCIOFLUSH);
}

void SerialPort::set_rate(int baud) {
  const auto rate =
      std::find_if(kRates.begin(), kRates.end(), [baud](const Rate& r) { return r.baud == baud; });
  if (rate == kRates.end()) fail(EINVAL, "unknown baud rate");
  termios settings{};
  if (::tcgetattr(fd_, &settings) != 0) fail(errno, "is not a serial device");
  ::cfsetispeed(&settings, rate->code);
  ::cfsetospeed(&settings, rate->code);
  if (::tcsetattr(fd_, TCSANOW, &settings) != 0) fail(errno, "cannot be configured");
}

void SerialPort::set_baud(int baud) {
  constexpr double kMaxRequest_s = 0.3;
  drain(kMaxRequest_s);
  set_rate(baud);
}

// Whether the port becomes ready for `events` before the timeout or a wakeup.
bool SerialPort::wait_for(short events, double timeout_s) const {
  std::array<pollfd, 2> entries{
      {{fd_, events, 0}, {wakeup_ != nullptr ? wakeup_->descriptor() : -1, POLLIN, 0}}};
  const int timeout_ms = static_cast<int>(std::ceil(std::max(0.0, timeout_s) * 1e3));
  return ::poll(entries.data(), entries.size(), timeout_ms) > 0 && entries[0].revents != 0;
}

std::string SerialPort::read(double timeout_s) {
  if (!wait_for(POLLIN, timeout_s)) return {};
  std::array<char, 512> buffer;
  const ssize_t n = ::read(fd_, buffer.data(), buffer.size());
  if (n > 0) return {buffer.data(), static_cast<std::size_t>(n)};
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return {};
  fail(n == 0 ? EIO : errno, "has vanished");
}

void SerialPort::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
    if (n >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno == EAGAIN) {
      pollfd woken{wakeup_ != nullptr ? wakeup_->descriptor() : -1, POLLIN, 0};
      if (wait_for(POLLOUT, kMaxWrite_s)) continue;
      if (::poll(&woken, 1, 0) > 0) return;
      fail(ETIMEDOUT, "accepts no bytes");
    } else if (errno != EINTR) {
      fail(errno, "cannot be written");
    }
  }
}

bool SerialPort::write_first(std::string_view bytes) {
  ::tcflush(fd_, TCOFLUSH);
  return ::write(fd_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
}

bool SerialPort::drain(double timeout_s) {
  constexpr double kLook_s = 0.002;
  for (double waited_s = 0.0;; waited_s += kLook_s) {
    int queued = 0;
    if (::ioctl(fd_, TIOCOUTQ, &queued) == 0 && queued == 0) return true;
    if (waited_s >= timeout_s) return false;
    ::poll(nullptr, 0, static_cast<int>(kLook_s * 1e3));
  }
}

}  // namespace ols::serial
