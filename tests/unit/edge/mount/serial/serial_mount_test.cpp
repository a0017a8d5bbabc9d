// Pan-tilt heads on pseudo terminals.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "base/process/clocks.h"
#include "edge/mount/serial/pelco_d.h"
#include "edge/mount/serial/serial_kinds.h"
#include "edge/mount/serial/visca_head.h"
#include "geometry/angles.h"
#include "tests/unit/eventually.h"

namespace ols::serial_mount {
namespace {

using ::testing::ElementsAre;
using Bytes = std::vector<int>;

Bytes bytes_of(const std::string& text) {
  Bytes bytes;
  for (const unsigned char c : text) bytes.push_back(c);
  return bytes;
}
std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// The protocol manual's own examples.
TEST(PelcoD, SaysWhatItsManualSays) {
  const PelcoD head(1);
  EXPECT_EQ(bytes_of(head.stop()), (Bytes{0xff, 1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(bytes_of(head.velocity(0.5, 0.0)), (Bytes{0xff, 1, 0, 4, 0x20, 0, 0x25}));
  EXPECT_EQ(bytes_of(head.velocity(-1.0, -1.0)), (Bytes{0xff, 1, 0, 0x12, 0x3f, 0x3f, 0x91}));
  EXPECT_EQ(bytes_of(head.place(-10.0, 45.0)),
            (Bytes{0xff, 1, 0, 0x4b, 0x88, 0xb8, 0x8c, 0xff, 1, 0, 0x4d, 0x11, 0x94, 0xf3}));
}

TEST(PelcoD, ReadsAnswersAmongRubbish) {
  PelcoD head(1);
  head.receive(text_of({0x00, 0xff, 1, 0, 0x59, 0x11}));
  EXPECT_FALSE(head.position().pan);
  head.receive(text_of({0x94, 0xff, 0xff, 1, 0, 0x5b, 0x01, 0x00, 0x5d}));
  EXPECT_DOUBLE_EQ(head.position().pan.value_or(-1.0), 45.0);
  EXPECT_DOUBLE_EQ(head.position().tilt.value_or(-1.0), 2.56);
  EXPECT_EQ(head.garbled(), 1);
  head.restart();
  head.receive(text_of({0xff, 2, 0, 0x59, 0x11, 0x94, 0x00}));  // another head's
  head.receive(text_of({0xff, 1, 0, 0x59, 0xff, 0xff, 0x58}));  // more than a turn
  EXPECT_FALSE(head.position().pan);
}

TEST(ViscaHead, SpeaksTheCommandList) {
  ViscaHead head;
  EXPECT_EQ(bytes_of(head.stop()), (Bytes{0x81, 1, 6, 1, 1, 1, 3, 3, 0xff}));
  EXPECT_EQ(bytes_of(head.velocity(1.0, -0.5)), (Bytes{0x81, 1, 6, 1, 0x18, 0x0a, 1, 2, 0xff}));
  EXPECT_EQ(bytes_of(head.place(-2.0, 0x123)),
            (Bytes{0x81, 1, 6, 2, 0x18, 0x14, 15, 15, 15, 14, 0, 1, 2, 3, 0xff}));
  head.receive(text_of({0x90, 0x41, 0xff, 0x90, 0x50, 15, 15, 15, 14, 0, 1, 2, 3, 0xff}));
  EXPECT_DOUBLE_EQ(head.position().pan.value_or(0.0), -2.0);
  EXPECT_DOUBLE_EQ(head.position().tilt.value_or(0.0), 0x123);
  head.receive(text_of({0x90, 0x50, 0x80, 15, 15, 14, 0, 1, 2, 3, 0xff}));
  EXPECT_EQ(head.garbled(), 1);
}

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
      received_.append(buffer, static_cast<std::size_t>(count));
      while (const auto one = next()) obey(*one);
    }
  }
  std::optional<Bytes> next() {
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
    ASSERT_EQ(sum(b), b[6]);
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
  std::jthread thread_;
};

std::unique_ptr<mount::Mount> mount_of(Language language, const std::string& device) {
  SerialConfig config;
  config.device = device;
  const double unit_rad = language == Language::kPelcoD ? radians(1.0) : 0.001;
  config.drive.pan = {0.0, -unit_rad, 0.5};
  config.drive.tilt = {0.0, unit_rad, 0.5};
  config.drive.limits.tilt_min_rad = radians(-40.0);
  config.drive.limits.tilt_max_rad = radians(80.0);
  if (language == Language::kVisca) {
    ViscaKind kind;
    kind.serial = config;
    return kind.open();
  }
  PelcoDKind kind;
  kind.serial = config;
  return kind.open();
}

class SerialMount : public ::testing::TestWithParam<Language> {};

TEST_P(SerialMount, GoesFollowsAndHalts) {
  Head head(GetParam());
  const auto mount = mount_of(GetParam(), head.device());
  ASSERT_TRUE(eventually([&] { return mount->reference() == mount::Reference::kTrusted; }));
  const PanTilt place{radians(-12.0), radians(-5.0)};
  ASSERT_TRUE(eventually([&] {
    const double now_s = clock_monotonic_s();
    mount->set_goal(mount::Goal{now_s, place, {}, now_s + 1.0, false, true});
    return !head.turns() && mount::distance(head.angles(), place) < radians(0.15);
  })) << mount->report().text;

  const PanTilt rate{radians(6.0), radians(2.0)};
  const double began_s = clock_monotonic_s();
  double worst_rad = 0.0;
  ASSERT_TRUE(eventually([&] {
    const double now_s = clock_monotonic_s(), ran_s = now_s - began_s;
    const PanTilt to{place.pan_rad + rate.pan_rad * ran_s, place.tilt_rad + rate.tilt_rad * ran_s};
    mount->set_goal(mount::Goal{now_s, to, rate, now_s + 1.0});
    const PanTilt at = head.angles();
    if (ran_s > 2.5) worst_rad = std::max(worst_rad, mount::distance(at, to));
    return ran_s > 4.0;
  }));
  std::printf("follows 6 deg/s within %.2f deg\n", degrees(worst_rad));
  EXPECT_LT(worst_rad, radians(3.0));

  ASSERT_TRUE(head.turns());
  mount->emergency_halt();
  ASSERT_TRUE(eventually([&] {
    const double now_s = clock_monotonic_s();  // whatever is wanted meanwhile
    mount->set_goal(mount::Goal{now_s, {}, rate, now_s + 60.0, true});
    return !head.turns();
  }));
}

TEST_P(SerialMount, StopsAHeadThatIsSilent) {
  Head head(GetParam());
  {
    const auto mount = mount_of(GetParam(), head.device());
    ASSERT_TRUE(eventually([&] { return mount->limits().has_value(); }));
    const auto turn = [&] {
      const double now_s = clock_monotonic_s();
      mount->set_goal(mount::Goal{now_s, {}, {radians(5.0), 0.0}, now_s + 60.0, true});
    };
    ASSERT_TRUE(eventually([&] {
      turn();
      return head.turns();
    }));
    head.be_silent(true);
    ASSERT_TRUE(eventually([&] { return !head.turns(); })) << "no position, no motion";
    ASSERT_TRUE(eventually([&] { return !mount->limits(); })) << "it is opened anew";
    head.be_silent(false);
    ASSERT_TRUE(eventually([&] { return mount->limits().has_value(); }));
    ASSERT_TRUE(eventually([&] {
      turn();
      return head.turns();
    }));
  }
  EXPECT_TRUE(eventually([&] { return !head.turns(); })) << "its station ends";
}

INSTANTIATE_TEST_SUITE_P(Languages, SerialMount,
                         ::testing::Values(Language::kPelcoD, Language::kVisca));

}  // namespace
}  // namespace ols::serial_mount
