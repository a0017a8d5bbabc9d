#include "central/admission/pointing_monitor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::fusion {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000;
const Eigen::Vector2d kOff(0.08, 0.01);

// 15 bearings a second from `from_s` to `to_s`.
void hear(PointingMonitor& monitor, double from_s, double to_s, bool explained,
          const std::optional<Eigen::Vector2d>& off_rad) {
  for (double t_s = from_s; t_s < to_s; t_s += 1.0 / 15.0) {
    monitor.hear("a", kStart + std::llround(t_s * 1e6), explained, off_rad);
  }
}

TEST(PointingMonitor, NamesWhoIsAlwaysOffByTheSame) {
  PointingMonitor monitor;
  hear(monitor, 0.0, 6.0, false, kOff);
  EXPECT_EQ(monitor.quarantine("a"),
            "station a: not used, its bearings are 4.6 deg off the target of the other stations");
  EXPECT_EQ(monitor.quarantine("b"), "");
}

TEST(PointingMonitor, BelievesAgainWhoIsExplained) {
  PointingMonitor monitor;
  hear(monitor, 0.0, 6.0, false, kOff);
  hear(monitor, 6.0, 12.0, true, std::nullopt);
  EXPECT_EQ(monitor.quarantine("a"), "");
}

// Otherwise no target could be initiated again if it needs this station.
TEST(PointingMonitor, LapsesWithoutATargetToJudgeBy) {
  PointingMonitor monitor;
  hear(monitor, 0.0, 6.0, false, kOff);
  hear(monitor, 6.0, 10.0, false, std::nullopt);
  EXPECT_NE(monitor.quarantine("a"), "");
  hear(monitor, 10.0, 12.0, false, std::nullopt);
  EXPECT_EQ(monitor.quarantine("a"), "");
  hear(monitor, 12.0, 18.0, false, kOff);
  EXPECT_NE(monitor.quarantine("a"), "") << "as soon as there is one again";
}

}  // namespace
}  // namespace ols::fusion
