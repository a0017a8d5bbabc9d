#include "tools/sim/ptu_line.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <thread>

#include "base/clocks.h"

namespace ols::sim {

namespace {

constexpr double kLongestSleep_s = 0.02;  // so that an end is noticed
constexpr double kBatch_s = 1e-3;         // bytes that come within this are handed on together

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

}  // namespace

struct PtuLine::Impl {
  Impl(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link_path)
      : unit(config, seed, clock_monotonic_s()),
        master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)),
        device(slave_name(master.get())),
        slave(::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)),
        link(link_path) {
    if (slave.get() < 0) fail(device);
    make_raw(slave.get());
    if (!link.empty()) {
      if (std::filesystem::is_symlink(link)) std::filesystem::remove(link);
      std::filesystem::create_symlink(device, link);
    }
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  ~Impl() {
    std::error_code ignored;
    if (!link.empty() && std::filesystem::read_symlink(link, ignored) == device) {
      std::filesystem::remove(link, ignored);
    }
  }

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      wait();
      std::array<char, 512> buffer;
      const ssize_t n = ::read(master.get(), buffer.data(), buffer.size());
      const double now_s = clock_monotonic_s();
      std::string out;
      {
        const std::lock_guard lock(mutex);
        latest_s = std::max(latest_s, now_s);
        if (n > 0) unit.receive({buffer.data(), static_cast<std::size_t>(n)}, latest_s);
        pending += unit.transmit(latest_s);
        out.swap(pending);
      }
      // A line that nobody reads loses its bytes, here once the pty's buffer is full.
      if (!out.empty()) static_cast<void>(!::write(master.get(), out.data(), out.size()));
    }
  }

  // Until bytes arrive or the unit has some.
  void wait() {
    double sleep_s = kLongestSleep_s;
    {
      const std::lock_guard lock(mutex);
      if (const auto next_s = unit.next_output_s()) {
        sleep_s = std::clamp(*next_s + kBatch_s - clock_monotonic_s(), 0.0, kLongestSleep_s);
      }
    }
    pollfd entry{master.get(), POLLIN, 0};
    const timespec timeout{0, static_cast<long>(sleep_s * 1e9)};
    ::ppoll(&entry, 1, &timeout, nullptr);
  }

  std::mutex mutex;  // of unit, pending, latest_s
  PtuUnit unit;
  std::string pending;
  double latest_s = 0.0;
  Descriptor master;
  std::string device;
  Descriptor slave;  // held open, so that a client that leaves does not hang the line up
  std::string link;
  std::jthread thread;  // last: it uses the rest
};

PtuLine::PtuLine(const PtuUnitConfig& config, std::uint64_t seed, const std::string& link)
    : impl_(std::make_unique<Impl>(config, seed, link)) {}

PtuLine::~PtuLine() = default;

const std::string& PtuLine::device() const { return impl_->device; }

PanTilt PtuLine::angles_at(double monotonic_time_s) {
  const std::lock_guard lock(impl_->mutex);
  // What the unit has received by now takes effect first.
  impl_->latest_s = std::max(impl_->latest_s, clock_monotonic_s());
  impl_->pending += impl_->unit.transmit(impl_->latest_s);
  return impl_->unit.angles_at(monotonic_time_s);
}

}  // namespace ols::sim
