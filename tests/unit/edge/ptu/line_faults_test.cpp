// What is published while the line is bad. Replies have no checksum: a wrong digit is a plausible
// number, and yet no angle may be off by more than its sigmas allow.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "tests/unit/edge/ptu/published_angles.h"

namespace ols::ptu {
namespace {

// A share of the replies gets one byte lost, changed or put in, digits more often than not.
class Garbler {
 public:
  Garbler(double share, unsigned seed) : share_(share), random_(seed) {}

  void operator()(std::string& bytes) {
    std::string out;
    for (const char byte : bytes) {
      if (at_ == 0) draw();
      const bool here = victim_ && at_ == *victim_;
      ++at_;
      if (byte == '\n') at_ = 0;
      if (!here || kind_ == 2) out.push_back(byte);
      if (here && kind_ != 0) out.push_back(another());
    }
    bytes = out;
  }
  int garbled = 0;

 private:
  void draw() {
    victim_.reset();
    if (unit_(random_) >= share_) return;
    victim_ = static_cast<std::size_t>(8.0 * unit_(random_));
    kind_ = static_cast<int>(3.0 * unit_(random_));  // lost, changed, put in
    ++garbled;
  }
  char another() {
    if (unit_(random_) < 0.7)
      return static_cast<char>('0' + static_cast<int>(10.0 * unit_(random_)));
    return static_cast<char>(256.0 * unit_(random_));
  }

  double share_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
  std::size_t at_ = 0;
  std::optional<std::size_t> victim_;
  int kind_ = 0;
};

// One reply lost each so many seconds.
class Loser {
 public:
  explicit Loser(double every_s) : every_s_(every_s) {}
  void operator()(std::string& bytes, double time_s) {
    if (next_s_ == 0.0) next_s_ = time_s + every_s_;
    std::string out;
    for (const char byte : bytes) {
      if (start_ && time_s >= next_s_ && byte != '\r' && byte != '\n') {
        losing_ = true;
        next_s_ += every_s_;
        ++lost;
      }
      start_ = byte == '\n';
      if (!losing_) out.push_back(byte);
      if (start_) losing_ = false;
    }
    bytes = out;
  }
  int lost = 0;

 private:
  double every_s_, next_s_ = 0.0;
  bool start_ = true, losing_ = false;
};

// Everything that a station has its unit do: follow, stand, turn back, jump.
mount::Goal busy_goal(double t) {
  const double phase = std::fmod(t, 20.0);
  if (phase < 12.0) {
    return {0.0,
            {radians(20.0) * std::sin(0.8 * t), radians(8.0) * std::sin(1.3 * t)},
            {radians(16.0) * std::cos(0.8 * t), radians(10.4) * std::cos(1.3 * t)},
            0.0};
  }
  if (phase < 14.0) return {0.0, {radians(10.0), radians(-5.0)}, {}, 0.0};
  if (phase < 17.0) return {0.0, {radians(-40.0), radians(12.0)}, {}, 0.0};
  const double s = phase - 17.0;
  return {0.0,
          {radians(-40.0 + 20.0 * s), radians(12.0 - 2.0 * s)},
          {radians(20.0), radians(-2.0)},
          0.0};
}

struct Setting {
  const char* name;
  int baud;
  double poll_s;
  double worst_sigmas;
};

class LineFaults : public testing::TestWithParam<Setting> {
 protected:
  LineFaults() : loop_(driver(), unit()), published_(history()) {}

  static PtuConfig driver() {
    PtuConfig config = quick_driver(GetParam().baud);
    config.poll_interval_s = GetParam().poll_s;
    return config;
  }
  static sim::PtuUnitConfig unit() {
    sim::PtuUnitConfig config = quick_unit(GetParam().baud);
    config.reply_jitter_s = 0.003;
    return config;
  }
  static mount::AngleHistory::Config history() { return driver().history; }

  void fly(double duration_s, const std::function<void()>& each = {}) {
    ASSERT_TRUE(loop_.start(20.0));
    const double begin_s = loop_.time_s;
    double next_goal_s = begin_s;
    loop_.run(duration_s, [&] {
      if (each) each();
      if (loop_.time_s >= next_goal_s) {
        mount::Goal goal = busy_goal(loop_.time_s - begin_s);
        goal.time_s = loop_.time_s;
        goal.valid_until_s = loop_.time_s + 0.5;
        loop_.driver.set_goal(goal);
        next_goal_s += 1.0 / 15.0;
      }
      published_.step(loop_);
    });
    const PtuCounters& c = loop_.driver.counters();
    std::printf(
        "%-28s %s: %d angles, %d withheld, rms %.4f deg, worst %.3f deg, NEES %.2f, worst %.2f "
        "sigmas, beyond three %d; garbled %lu, refused %lu, timeouts %lu, echoes %lu, restarts "
        "%lu\n",
        testing::UnitTest::GetInstance()->current_test_info()->name(), GetParam().name,
        published_.published, published_.withheld, published_.rms_deg(), published_.worst_deg,
        published_.nees(), published_.worst_sigmas, published_.beyond_three, c.garbled,
        c.refused_positions, c.timeouts, c.echoes, c.restarts);
  }

  // Not more beyond three sigmas than honest sigmas have (0.27 % of a Gaussian's), and none far
  // off.
  void expect_honest() {
    EXPECT_LE(published_.beyond_three, std::max(1, 2 * published_.published / 2000));
    EXPECT_LT(published_.worst_sigmas, GetParam().worst_sigmas);
  }

  ClosedLoop loop_;
  PublishedAngles published_;
};

TEST_P(LineFaults, None) {
  fly(200.0);
  expect_honest();
  EXPECT_EQ(published_.beyond_three, 0);
  EXPECT_LT(published_.withheld, 5);  // at the beginning
  EXPECT_EQ(loop_.driver.counters().refused_positions, 0u);
  EXPECT_EQ(loop_.driver.counters().garbled, 0u);
}

TEST_P(LineFaults, OnePercentGarbled) {
  Garbler garbler(0.01, 5);
  loop_.garble = [&](std::string& bytes) { garbler(bytes); };
  fly(2000.0);
  expect_honest();
  EXPECT_GT(garbler.garbled, 1000);
  EXPECT_LT(published_.withheld, published_.published / 100);
  EXPECT_EQ(loop_.driver.counters().restarts, 0u);
}

TEST_P(LineFaults, ARepliesLostNowAndThen) {
  Loser loser(2.0);
  loop_.garble = [&](std::string& bytes) { loser(bytes, loop_.time_s); };
  fly(400.0);
  expect_honest();
  EXPECT_GT(loser.lost, 150);
  EXPECT_EQ(loop_.driver.counters().restarts, 0u);
}

TEST_P(LineFaults, EchoSwitchedOnAgainAndAgain) {
  double next_s = loop_.time_s + 8.0;
  fly(200.0, [&] {
    if (loop_.time_s < next_s) return;
    loop_.unit.receive(" EE ", loop_.time_s);
    next_s += 3.1;
  });
  expect_honest();
  EXPECT_GT(loop_.driver.counters().echoes, 30u);
  EXPECT_EQ(loop_.driver.counters().restarts, 0u);
}

// No byte either way for five seconds: told, stopped, and on again without jumping to an old goal.
TEST_P(LineFaults, CutForFiveSeconds) {
  const double cut_s = loop_.time_s + 24.0;
  loop_.garble = [&](std::string& bytes) {
    if (loop_.cut) bytes.clear();
  };
  fly(60.0, [&] { loop_.cut = loop_.time_s > cut_s && loop_.time_s < cut_s + 5.0; });
  expect_honest();
  EXPECT_GE(loop_.driver.counters().restarts, 1u);
  EXPECT_EQ(loop_.driver.state(), PtuState::kReady);
  EXPECT_GT(published_.published, 15 * 45);
}

INSTANTIATE_TEST_SUITE_P(Rates, LineFaults,
                         testing::Values(Setting{"38400 baud", 38400, 0.025, 4.5},
                                         Setting{"9600 baud", 9600, 0.075, 6.0}),
                         [](const auto& test) { return "At" + std::to_string(test.param.baud); });

}  // namespace
}  // namespace ols::ptu
