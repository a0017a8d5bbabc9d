#include <gtest/gtest.h>

#include "edge/camera/exposure_log.h"
#include "edge/camera/frame_numbers.h"
#include "edge/camera/frame_statistics.h"
#include "edge/camera/ptp.h"

namespace ols::camera {
namespace {

TEST(FrameStatistics, RateAndLossesOfLate) {
  FrameStatistics statistics;
  EXPECT_DOUBLE_EQ(statistics.rate_hz(), 0.0);
  for (int i = 0; i < 200; ++i) statistics.add(0.1 * i, true);
  EXPECT_NEAR(statistics.rate_hz(), 10.0, 0.01);
  EXPECT_DOUBLE_EQ(statistics.incomplete_share(), 0.0);
  for (int i = 200; i < 400; ++i) statistics.add(0.1 * i, i % 2 == 0);
  EXPECT_NEAR(statistics.rate_hz(), 5.0, 0.2);
  EXPECT_NEAR(statistics.incomplete_share(), 0.5, 0.02);
}

TEST(FrameNumbers, CountsOnAcrossTheWrapThatSkipsZero) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(65534).number;
  EXPECT_EQ(numbers.next(65535).number, first + 1);
  const auto wrapped = numbers.next(1);
  EXPECT_EQ(wrapped.number, first + 2);
  EXPECT_EQ(wrapped.lost, 0U);
  EXPECT_EQ(numbers.next(2).number, first + 3);
}

TEST(FrameNumbers, CountsWhatIsMissing) {
  FrameNumbers numbers;
  EXPECT_EQ(numbers.next(10).lost, 0U);
  EXPECT_EQ(numbers.next(13).lost, 2U);
  EXPECT_EQ(numbers.next(14).lost, 0U);
}

TEST(FrameNumbers, CountsWhatIsMissingAcrossTheWrap) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(65533).number;
  const auto step = numbers.next(3);  // 65534, 65535, 1, 2 are missing
  EXPECT_EQ(step.lost, 4U);
  EXPECT_EQ(step.number, first + 5);
}

TEST(FrameNumbers, ACameraThatBeginsAgainLosesNothingAndNumbersGoOn) {
  FrameNumbers numbers;
  const std::uint64_t before = numbers.next(500).number;
  const auto again = numbers.next(1);
  EXPECT_EQ(again.lost, 0U);
  EXPECT_EQ(again.number, before + 1);
  numbers.restart();
  const auto reopened = numbers.next(30000);
  EXPECT_EQ(reopened.lost, 0U);
  EXPECT_EQ(reopened.number, before + 2);
}

TEST(FrameNumbers, TakesIdsOf64Bits) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(65535).number;
  EXPECT_EQ(numbers.next(65536).number, first + 1);
  const auto step = numbers.next(70000);
  EXPECT_EQ(step.lost, 70000U - 65536U - 1U);
  EXPECT_EQ(step.number, first + 1 + (70000U - 65536U));
}

TEST(FrameNumbers, TheSameIdTwiceIsNotALoss) {
  FrameNumbers numbers;
  const std::uint64_t first = numbers.next(7).number;
  const auto again = numbers.next(7);
  EXPECT_EQ(again.lost, 0U);
  EXPECT_GT(again.number, first);
}

TEST(PtpState, TheWordsOfDifferentFirmware) {
  EXPECT_EQ(ptp_state("Slave"), PtpState::kSlave);
  for (const char* word : {"Syncing", "Uncalibrated", "Listening", "Initializing"})
    EXPECT_EQ(ptp_state(word), PtpState::kSyncing) << word;
  EXPECT_EQ(ptp_state("Master"), PtpState::kMaster);
  EXPECT_EQ(ptp_state("Disabled"), PtpState::kOff);
  EXPECT_EQ(ptp_state("Off"), PtpState::kOff);
  EXPECT_EQ(ptp_state("Faulty"), PtpState::kFault);
  EXPECT_EQ(ptp_state("Dreaming"), PtpState::kUnknown);
}

constexpr double kPeriod_s = 0.1;

TEST(ExposureLog, KnowsTheOneExposureThereIs) {
  const ExposureLog log(0.005, kPeriod_s);
  EXPECT_DOUBLE_EQ(log.at(3.0).exposure_s, 0.005);
  EXPECT_DOUBLE_EQ(log.at(3.0).sd_s, 0.0);
  EXPECT_DOUBLE_EQ(log.newest_s(), 0.005);
}

TEST(ExposureLog, BeforeAChangeTheOldOneAndAFramePeriodAfterItTheNewOneIsCertain) {
  ExposureLog log(0.004, kPeriod_s);
  log.change(10.0, 10.002, 0.008);
  EXPECT_DOUBLE_EQ(log.newest_s(), 0.008);
  EXPECT_DOUBLE_EQ(log.at(9.999).exposure_s, 0.004);
  EXPECT_DOUBLE_EQ(log.at(9.999).sd_s, 0.0);
  EXPECT_DOUBLE_EQ(log.at(10.103).exposure_s, 0.008);
  EXPECT_DOUBLE_EQ(log.at(10.103).sd_s, 0.0);
}

TEST(ExposureLog, InBetweenEitherMayBeTrue) {
  ExposureLog log(0.004, kPeriod_s);
  log.change(10.0, 10.002, 0.008);
  for (const double start_s : {10.001, 10.05, 10.101}) {
    EXPECT_DOUBLE_EQ(log.at(start_s).exposure_s, 0.006);
    EXPECT_DOUBLE_EQ(log.at(start_s).sd_s, 0.002);
  }
}

TEST(ExposureLog, ManyChangesEndAtTheLastOne) {
  ExposureLog log(0.001, kPeriod_s);
  for (int i = 1; i <= 50; ++i) log.change(i, i + 0.001, 0.001 * i);
  EXPECT_DOUBLE_EQ(log.at(50.5).exposure_s, 0.050);
  EXPECT_DOUBLE_EQ(log.at(50.5).sd_s, 0.0);
  EXPECT_DOUBLE_EQ(log.at(48.5).exposure_s, 0.048);
}

}  // namespace
}  // namespace ols::camera
