// The driver and the simulated lens joined by a line, in simulated time.
#include "edge/lens/lens_driver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/lens/lens_unit.h"

namespace ols::lens {
namespace {

constexpr double kLease_s = 0.3;

class LensLoop : public testing::Test {
 protected:
  void run(double seconds) {
    const double end_s = now_s_ + seconds;
    while (now_s_ < end_s) {
      now_s_ += 1e-3;
      const std::string request = driver_.step(now_s_);
      const bool refuses = !refused_.empty() && request == refused_;
      if (refuses) driver_.receive("\x90\x61\x41\xff", now_s_);
      if (!cut_ && !refuses) unit_.receive(request, now_s_);
      const std::string heard = unit_.transmit(now_s_);
      if (!cut_) driver_.receive(heard, now_s_);
      for (const ZoomSample& sample : driver_.take_samples()) samples_.push_back(sample);
    }
  }
  void rate(Axis axis, double rate) {
    LensOrder order;
    order.axes[axis] = AxisOrder{std::nullopt, rate, now_s_ + kLease_s};
    driver_.order(order);
  }
  void position(Axis axis, double position) {
    LensOrder order;
    order.axes[axis] = AxisOrder{position, 0.0, 0.0};
    driver_.order(order);
  }

  sim::LensUnit unit_{sim::LensUnitConfig{}, 10.0};
  LensDriver driver_{0.05};
  double now_s_ = 10.0;
  bool cut_ = false;
  std::string refused_;  // a request that the lens cannot execute
  std::vector<ZoomSample> samples_;
};

TEST_F(LensLoop, BecomesReadyAndKnowsWhereEverythingIs) {
  run(1.0);
  EXPECT_TRUE(driver_.state().ready);
  EXPECT_EQ(driver_.state().version, "vendor 0020, model 0466, ROM 0105");
  EXPECT_EQ(driver_.state().positions.zoom, 0.0);
  EXPECT_EQ(driver_.state().positions.focus, 0.0);
  EXPECT_EQ(driver_.state().positions.iris, 1.0);
  EXPECT_EQ(driver_.counters().timeouts + driver_.counters().garbled, 0U);
}

TEST_F(LensLoop, GoesToPositions) {
  run(0.5);
  position(Axis::kZoom, 0.4);
  position(Axis::kFocus, 0.7);
  position(Axis::kIris, 0.0);
  run(2.5);
  EXPECT_NEAR(unit_.zoom_at(now_s_), 0.4, 1e-4);
  EXPECT_NEAR(unit_.focus_at(now_s_), 0.7, 1e-4);
  EXPECT_EQ(unit_.iris(), 0);
  EXPECT_NEAR(*driver_.state().positions.zoom, 0.4, 1e-4);
}

// A sample's stated time is where the truth was.
TEST_F(LensLoop, SamplesOfAMovingZoomAreDatedHonestly) {
  run(0.5);
  position(Axis::kZoom, 1.0);
  run(2.0);
  double squares = 0.0;
  int moving = 0;
  for (const ZoomSample& sample : samples_) {
    const double error = sample.position - unit_.zoom_at(sample.time_s);
    if (sample.time_s < 10.7) continue;
    squares += std::pow(error / (sample.time_sd_s / 3.0), 2);
    ++moving;
  }
  ASSERT_GT(moving, 20);
  EXPECT_LT(squares / moving, 4.0);
}

TEST_F(LensLoop, ARateEndsWithItsLease) {
  run(0.5);
  for (int i = 0; i < 5; ++i) {
    rate(Axis::kZoom, 1.0);
    run(0.1);
  }
  EXPECT_GT(unit_.zoom_at(now_s_), 0.1);
  run(kLease_s + 0.1);
  const double stood = unit_.zoom_at(now_s_);
  run(1.0);
  EXPECT_EQ(unit_.zoom_at(now_s_), stood);
  rate(Axis::kZoom, 1.0);
  run(0.1);
  rate(Axis::kZoom, 0.0);
  run(0.1);
  const double let_go = unit_.zoom_at(now_s_);
  run(0.3);
  EXPECT_EQ(unit_.zoom_at(now_s_), let_go) << "rates of zero end it at once";
}

TEST_F(LensLoop, TheIrisStepsAtItsRate) {
  run(0.5);
  for (int i = 0; i < 10; ++i) {
    rate(Axis::kIris, -1.0);
    run(0.1);
  }
  run(1.0);
  EXPECT_LT(unit_.iris(), 0x11 - 3);
  EXPECT_GT(unit_.iris(), 0x11 - 12);
}

TEST_F(LensLoop, ARateOfTheIrisThatIsRenewedKeepsItsPace) {
  run(0.5);
  for (int i = 0; i < 20; ++i) {
    rate(Axis::kIris, -0.2);  // a step in 0.75 s
    run(0.1);
  }
  run(1.0);
  EXPECT_LE(unit_.iris(), 0x11 - 2);
  EXPECT_GE(unit_.iris(), 0x11 - 4);
}

TEST_F(LensLoop, ALensThatRefusesToStandIsStillAskedForItsZoom) {
  run(0.5);
  refused_ = visca::stand(Axis::kFocus);
  rate(Axis::kFocus, 0.5);
  run(1.0);
  samples_.clear();
  const auto refusals = driver_.counters().refusals;
  EXPECT_GT(refusals, 0U);
  run(1.0);
  EXPECT_GT(samples_.size(), 5U);
  EXPECT_EQ(driver_.counters().refusals, refusals) << "it is not told for ever";
}

// The end of a rate that was lost on the line is sent again.
TEST_F(LensLoop, AnEndThatWasLostIsSentAgain) {
  run(0.5);
  rate(Axis::kZoom, 0.5);
  run(0.2);
  cut_ = true;
  run(0.4);
  cut_ = false;
  run(0.8);
  const double stood = unit_.zoom_at(now_s_);
  EXPECT_LT(stood, 0.9);
  run(1.0);
  EXPECT_EQ(unit_.zoom_at(now_s_), stood);
  EXPECT_GT(driver_.counters().timeouts, 0U);
}

TEST_F(LensLoop, ASilentLensIsSaidToBeLost) {
  run(0.5);
  cut_ = true;
  run(LensDriver::kReply_s * (LensDriver::kSilent + 2));
  EXPECT_TRUE(driver_.take_link_loss());
  EXPECT_FALSE(driver_.take_link_loss());
  driver_.restart();
  EXPECT_FALSE(driver_.state().ready);
  cut_ = false;
  run(1.0);
  EXPECT_TRUE(driver_.state().ready);
}

TEST_F(LensLoop, RubbishOnTheLineIsCountedAndCostsNothing) {
  run(0.5);
  driver_.receive("rubbish\xff and more that is too long for a packet", now_s_);
  run(1.0);
  EXPECT_GT(driver_.counters().garbled, 1U);
  position(Axis::kZoom, 0.2);
  run(1.5);
  EXPECT_NEAR(unit_.zoom_at(now_s_), 0.2, 1e-4);
}

}  // namespace
}  // namespace ols::lens
