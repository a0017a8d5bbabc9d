#include "export/sapient/sapient_encoder.h"

#include "tests/unit/export/made_records.h"
#include "tests/unit/export/sapient/said.h"

namespace ols::exports {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;

TEST(SapientEncoder, ReportsItsStateAtTheInterval) {
  SapientEncoder encoder({.site = "brno", .status_s = 3.0});
  int reports = 0;
  for (int second = 0; second < 9; ++second) {
    // Turns jitter, and the stations are heard all the time.
    Station station = made_station();
    station.utime_us = kNow_us + second * kSecond_us;
    EXPECT_TRUE(encoder.encode(station).empty());
    const auto packets = encoder.due(kNow_us + second * kSecond_us - 1000 * (second % 2));
    reports += static_cast<int>(packets.size());
    if (!packets.empty()) {
      EXPECT_EQ(said(packets[0].bytes).status_report().status(0).status_value(), "alfa: tracking");
    }
  }
  EXPECT_EQ(reports, 3);
}

TEST(SapientEncoder, ANewConnectionAndAClockThatWasSetBackGetAReportAtOnce) {
  SapientEncoder encoder({.status_s = 60.0});
  EXPECT_EQ(encoder.due(kNow_us).size(), 1U);
  EXPECT_TRUE(encoder.due(kNow_us + kSecond_us).empty());
  encoder.begin_again();
  EXPECT_EQ(encoder.due(kNow_us + 2 * kSecond_us).size(), 1U);
  EXPECT_EQ(encoder.due(kNow_us - 3600 * kSecond_us).size(), 1U);
}

TEST(SapientEncoder, ASilentStationIsNotToldOf) {
  SapientEncoder encoder({.status_s = 1.0});
  encoder.encode(made_station());
  const auto state = [&](std::int64_t after_us) {
    return said(encoder.due(kNow_us + after_us).at(0).bytes).status_report().status(0);
  };
  EXPECT_EQ(state(5 * kSecond_us).status_value(), "alfa: tracking");
  EXPECT_EQ(state(11 * kSecond_us).status_value(), "no station is heard");
}

TEST(SapientEncoder, TargetsOfOneScanHaveOneTimeAndLinesAreNotThere) {
  SapientEncoder encoder({});
  const auto first = said(encoder.encode(made_target(1)).at(0).bytes);
  const auto second = said(encoder.encode(made_target(2, 30'000)).at(0).bytes);
  EXPECT_EQ(first.timestamp().nanos(), second.timestamp().nanos());
  EXPECT_TRUE(encoder.encode(made_target(1, 40'000)).empty());
  EXPECT_TRUE(encoder.encode(made_line()).empty());
}

}  // namespace
}  // namespace ols::exports
