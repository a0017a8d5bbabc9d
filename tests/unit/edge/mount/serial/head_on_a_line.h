// A pan-tilt head on a pseudo terminal.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/process/clocks.h"
#include "edge/mount/serial/serial_config.h"
#include "geometry/angles.h"
#include "geometry/kinematic_chain.h"

namespace ols::serial_mount {

using Bytes = std::vector<int>;

inline Bytes bytes_of(const std::string& text) {
  Bytes bytes;
  for (const unsigned char c : text) bytes.push_back(c);
  return bytes;
}
inline std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// A head that turns at once as it is told, by its own reading of the bytes.
class Head {
 public:
  explicit Head(Language language)
      : language_(language), master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    ::grantpt(master_);
    ::unlockpt(master_);
    device_ = ::ptsname(master_);
    keeps_open_ = ::open(device_.c_str(), O_RDWR | O_NOCTTY);
    termios raw{};
    ::tcgetattr(keeps_open_, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(keeps_open_, TCSANOW, &raw);
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~Head() {
    thread_.request_stop();
    thread_.join();
    ::close(keeps_open_);
    ::close(master_);
  }

  const std::string& device() const { return device_; }
  PanTilt angles() {
    const std::lock_guard lock(mutex_);
    turn();
    return at_;
  }
  bool turns() {
    const std::lock_guard lock(mutex_);
    return rate_.pan_rad != 0.0 || rate_.tilt_rad != 0.0;
  }
  // Understands only this rate, in termios' notation.
  void listen_at(speed_t rate) {
    const std::lock_guard lock(mutex_);
    rate_of_line_ = rate;
  }
  void be_silent(bool silent) {
    const std::lock_guard lock(mutex_);
    silent_ = silent;
  }

 private:
  static constexpr double kFastest_rad_s = 0.5;

  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd ready{master_, POLLIN, 0};
      if (::poll(&ready, 1, 20) <= 0) continue;
      char buffer[256];
      const ssize_t count = ::read(master_, buffer, sizeof buffer);
      if (count <= 0) continue;
      const std::lock_guard lock(mutex_);
      termios line{};
      ::tcgetattr(master_, &line);
      if (rate_of_line_ != B0 && ::cfgetospeed(&line) != rate_of_line_) continue;
      received_.append(buffer, static_cast<std::size_t>(count));
      while (const auto one = next()) obey(*one);
    }
  }
  std::optional<Bytes> next() {
    if (language_ == Language::kPelcoD) received_.erase(0, received_.find('\xff'));
    const std::size_t end = language_ == Language::kPelcoD ? 7 : received_.find('\xff') + 1;
    if (end == 0 || received_.size() < end) return std::nullopt;
    const Bytes one = bytes_of(received_.substr(0, end));
    received_.erase(0, end);
    return one;
  }
  void turn() {
    const double now_s = clock_monotonic_s();
    at_.pan_rad += rate_.pan_rad * (now_s - then_s_);
    at_.tilt_rad += rate_.tilt_rad * (now_s - then_s_);
    then_s_ = now_s;
  }
  void say(const Bytes& bytes) {
    if (silent_) return;
    const std::string text = text_of(bytes);
    EXPECT_EQ(::write(master_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void obey(const Bytes& b) {
    turn();
    language_ == Language::kPelcoD ? obey_pelco(b) : obey_visca(b);
  }
  void obey_pelco(const Bytes& b) {
    const auto sum = [](const Bytes& m) { return (m[1] + m[2] + m[3] + m[4] + m[5]) & 0xff; };
    const auto answer = [&](int code, double angle_rad) {
      const int value = static_cast<int>(std::lround(100.0 * degrees(angle_rad)) + 36000) % 36000;
      Bytes message{0xff, 1, 0, code, value >> 8, value & 0xff, 0};
      message[6] = sum(message);
      say(message);
    };
    if (sum(b) != b[6]) return;
    const auto set = [&] { return radians(0.01 * (b[4] << 8 | b[5])); };
    const auto near = [](double angle_rad) { return std::remainder(angle_rad, 2.0 * kPi); };
    if (b[3] == 0x51) return answer(0x59, -at_.pan_rad);
    if (b[3] == 0x53) return answer(0x5b, at_.tilt_rad);
    if (b[3] == 0x4b || b[3] == 0x4d) rate_ = {};
    if (b[3] == 0x4b) at_.pan_rad = near(-set());
    if (b[3] == 0x4d) at_.tilt_rad = near(set());
    if ((b[3] & 1) != 0) return;
    const auto rate = [](int speed) { return kFastest_rad_s * speed / 0x3f; };
    rate_.pan_rad = (b[3] & 4) != 0 ? rate(b[4]) : (b[3] & 2) != 0 ? -rate(b[4]) : 0.0;
    rate_.tilt_rad = (b[3] & 8) != 0 ? rate(b[5]) : (b[3] & 16) != 0 ? -rate(b[5]) : 0.0;
  }
  void obey_visca(const Bytes& b) {
    if (b[0] != 0x81) return;  // not to it
    constexpr double kCount_rad = 0.001;
    const auto halves = [](int value) {
      return Bytes{(value >> 12) & 15, (value >> 8) & 15, (value >> 4) & 15, value & 15};
    };
    if (b[1] == 9) {
      Bytes message{0x90, 0x50};
      for (const double angle_rad : {-at_.pan_rad, at_.tilt_rad})
        for (const int half : halves(static_cast<int>(std::lround(angle_rad / kCount_rad))))
          message.push_back(half);
      message.push_back(0xff);
      return say(message);
    }
    say({0x90, 0x41, 0xff});
    if (b[3] == 2) {
      const auto value = [&](std::size_t i) {
        return static_cast<std::int16_t>(b[i] << 12 | b[i + 1] << 8 | b[i + 2] << 4 | b[i + 3]);
      };
      at_ = {-kCount_rad * value(6), kCount_rad * value(10)};
      rate_ = {};
    } else {
      const auto rate = [](int speed, int way, int fastest) {
        return way == 3 ? 0.0 : (way == 1 ? 1.0 : -1.0) * kFastest_rad_s * speed / fastest;
      };
      rate_ = {rate(b[4], b[6], 0x18), rate(b[5], b[7], 0x14)};
    }
    say({0x90, 0x51, 0xff});
  }

  const Language language_;
  const int master_;
  int keeps_open_ = -1;
  std::string device_, received_;
  std::mutex mutex_;
  PanTilt at_{radians(-3.0), radians(2.0)}, rate_;
  double then_s_ = clock_monotonic_s();
  bool silent_ = false;
  speed_t rate_of_line_ = B0;  // B0: any
  std::jthread thread_;
};

}  // namespace ols::serial_mount
