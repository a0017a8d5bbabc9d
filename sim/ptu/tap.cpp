#include "sim/ptu/tap.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <thread>

#include "base/process/clocks.h"
#include "edge/serial/serial_port.h"
#include "sim/ptu/reply_faults.h"
#include "sim/ptu/tap_watch.h"
#include "sim/serial/pty.h"

namespace ols::sim {

namespace {

constexpr double kTurn_s = 0.02;   // so that ends, faults and failures are noticed
constexpr double kRetry_s = 0.25;  // between attempts to open the device
constexpr double kLongestAwait_s = 0.08;
constexpr double kSilent_s = 0.3;  // a side that was silent for this long is not waited for

}  // namespace

// One thread owns the station's terminal and forwards its bytes; while the unit's device is open, a
// second one reads from it.
struct PtuTap::Impl {
  struct Session {
    Session(Impl& impl, int baud) : port(impl.config.device, baud) {
      listener =
          std::jthread([this, &impl](const std::stop_token& stop) { impl.listen(*this, stop); });
    }
    serial::SerialPort port;
    std::atomic<bool> failed = false;
    std::jthread listener;  // last: it uses the rest
  };

  Impl(const PtuTapConfig& tap_config, std::uint64_t seed, const std::string& link)
      : config(tap_config),
        baud(tap_config.baud),
        watch(config.step_rad),
        replies(seed),
        pty(link) {
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void run(const std::stop_token& stop) {
    double next_try_s = 0.0;
    while (!stop.stop_requested()) {
      if (session && session->failed) lose();
      if (!session && clock_monotonic_s() >= next_try_s) {
        open();
        next_try_s = clock_monotonic_s() + kRetry_s;
      }
      replug();
      pty.wait(kTurn_s);
      forward(pty.read());
    }
    session.reset();
  }

  void open() {
    try {
      session = std::make_unique<Session>(*this, baud);
      ++opened;
    } catch (const std::system_error&) {
      ++failures;
    }
  }

  void lose() {
    session.reset();
    ++failures;
    const std::lock_guard lock(mutex);
    watch.interrupted();
  }

  // The station's device exists while the unit's does.
  void replug() {
    bool wanted = session != nullptr;
    {
      const std::lock_guard lock(mutex);
      wanted = wanted && !faults.line_gone;
    }
    if (wanted == pty.plugged()) return;
    const std::lock_guard lock(pty_mutex);
    if (wanted) {
      pty.plug();
    } else {
      pty.unplug();
    }
  }

  // From the station to the unit, at the rate that the station has set.
  void forward(const std::string& bytes) {
    if (bytes.empty() || !session) return;
    const int wanted_baud = pty.client_baud();
    if (wanted_baud != 0 && wanted_baud != baud) {
      baud = wanted_baud;
      session.reset();
      open();
      if (!session) return;
    }
    {
      const std::lock_guard lock(mutex);
      if (faults.line_cut) return;
      watch.master_said(bytes, clock_monotonic_s(), byte_s());
    }
    try {
      session->port.write(bytes);
    } catch (const std::system_error&) {
      session->failed = true;
    }
  }

  // From the unit to the station.
  void listen(Session& from, const std::stop_token& stop) {
    try {
      while (!stop.stop_requested()) {
        std::string bytes = from.port.read(kTurn_s);
        if (bytes.empty()) continue;
        {
          const std::lock_guard lock(mutex);
          const double now_s = clock_monotonic_s();
          watch.unit_said(bytes, now_s, byte_s());
          bytes = faults.line_cut ? std::string() : replies.pass(bytes, now_s);
        }
        heard.notify_all();
        const std::lock_guard lock(pty_mutex);
        pty.write(bytes);
      }
    } catch (const std::system_error&) {
      from.failed = true;
    }
  }

  double byte_s() const { return 10.0 / baud; }

  const PtuTapConfig config;
  std::atomic<int> baud;
  std::atomic<std::uint64_t> opened = 0, failures = 0;
  std::condition_variable heard;
  mutable std::mutex mutex;  // for these three
  PtuTapWatch watch;
  PtuReplyFaults replies;
  PtuFaults faults;
  std::mutex pty_mutex;  // the listener writes, the owner plugs and unplugs
  Pty pty;
  std::unique_ptr<Session> session;  // only the owner's
  std::jthread thread;               // last: it uses the rest
};

PtuTap::PtuTap(const PtuTapConfig& config, std::uint64_t seed, const std::string& link)
    : impl_(std::make_unique<Impl>(config, seed, link)) {}

PtuTap::~PtuTap() = default;

void PtuTap::set_faults(const PtuFaults& faults) {
  const std::lock_guard lock(impl_->mutex);
  impl_->faults = faults;
  impl_->replies.set(faults.garble_share, faults.reply_lost_every_s, clock_monotonic_s());
}

void PtuTap::await(double monotonic_s) {
  std::unique_lock lock(impl_->mutex);
  if (monotonic_s - impl_->watch.known_until_s() > kSilent_s) return;
  impl_->heard.wait_for(lock, std::chrono::duration<double>(kLongestAwait_s),
                        [&] { return impl_->watch.known_until_s() >= monotonic_s; });
}

PanTilt PtuTap::angles_at(double monotonic_s) {
  const std::lock_guard lock(impl_->mutex);
  return impl_->watch.at(monotonic_s);
}

PtuTap::Counters PtuTap::counters() const {
  const std::lock_guard lock(impl_->mutex);
  return {impl_->opened, impl_->failures, impl_->watch.counters().readings,
          impl_->watch.counters().mismatched};
}

}  // namespace ols::sim
