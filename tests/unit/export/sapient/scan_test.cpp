#include "export/sapient/scan.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

TEST(Scan, TargetsOfNearlyOneInstantAreToldAtOne) {
  Scan scan;
  EXPECT_EQ(scan.instant_of(made_target(1)), kNow_us);
  EXPECT_EQ(scan.instant_of(made_target(2, 50'000)), kNow_us);
  EXPECT_EQ(scan.instant_of(made_target(3, -50'000)), kNow_us);
  EXPECT_EQ(scan.instant_of(made_target(1, 100'000)), kNow_us + 100'000);
}

TEST(Scan, ATargetIsToldOnceAtAnInstantUnlessItsStateChanges) {
  Scan scan;
  Target target = made_target();
  EXPECT_TRUE(scan.instant_of(target));
  target.utime_us += 60'000;
  EXPECT_EQ(scan.instant_of(target), std::nullopt);
  target.state = TrackState::kEnded;
  EXPECT_EQ(scan.instant_of(target), kNow_us);
  scan.begin_again();
  EXPECT_EQ(scan.instant_of(target), kNow_us);
}

TEST(Scan, AnInstantOfTheFutureDoesNotStayForEver) {
  Scan scan;
  EXPECT_TRUE(scan.instant_of(made_target(1, 5'000'000)));
  EXPECT_EQ(scan.instant_of(made_target(2)), kNow_us);
  Target absurd = made_target(3);
  absurd.utime_us = std::numeric_limits<std::int64_t>::min();
  EXPECT_TRUE(scan.instant_of(absurd));
  EXPECT_EQ(scan.instant_of(made_target(2)), kNow_us);
}

}  // namespace
}  // namespace ols::exports
