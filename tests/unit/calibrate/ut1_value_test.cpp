#include "tools/calibrate/ut1_value.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ols::calibration {
namespace {

constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr std::int64_t kNoon_us = 1'780'012'800'000'000 + kDay_us / 2;  // of 2026-05-29, UTC

TEST(Ut1Value, ItAgesByTheExcessLengthOfDayEitherWay) {
  const Ut1Value value{0.021, "2026-05-29"};
  EXPECT_DOUBLE_EQ(age_days(value, kNoon_us), 0.0);
  EXPECT_DOUBLE_EQ(age_days(value, kNoon_us + 10 * kDay_us), 10.0);
  EXPECT_DOUBLE_EQ(age_days(value, kNoon_us - 10 * kDay_us), 10.0);
  EXPECT_NEAR(ut1_sd_s(value, kNoon_us), 1e-3, 1e-12);
  EXPECT_NEAR(ut1_sd_s(value, kNoon_us + 100 * kDay_us), 0.1, 1e-5);
}

TEST(Ut1Value, NoneAndAVeryOldOneAreEquallyUncertain) {
  EXPECT_DOUBLE_EQ(ut1_sd_s({}, kNoon_us), 0.3);
  EXPECT_DOUBLE_EQ(ut1_sd_s({0.021, "2020-01-01"}, kNoon_us), 0.3);
}

TEST(Ut1Value, WhatAPersonShouldKnow) {
  EXPECT_NE(ut1_remark({}, kNoon_us).find("not stated (--ut1-utc)"), std::string::npos);
  EXPECT_NE(ut1_remark({0.021, ""}, kNoon_us).find("--ut1-date"), std::string::npos);
  EXPECT_EQ(ut1_remark({0.021, "2026-05-01"}, kNoon_us), "");
  EXPECT_EQ(ut1_remark({0.021, "2026-02-18"}, kNoon_us),
            "UT1 - UTC is old: its day, 2026-02-18, is 100 days from the observations', which adds "
            "1.5 arc seconds of heading");
}

TEST(Ut1Value, WhatIsNoDayIsRefused) {
  EXPECT_EQ(date_problem(""), "");
  EXPECT_EQ(date_problem("2024-02-29"), "");
  for (const char* text : {"2026-02-29", "2026-13-01", "29.5.2026", "2026-05-29T00:00", "today"}) {
    EXPECT_NE(date_problem(text).find(text), std::string::npos);
    EXPECT_THROW(age_days({0.0, text}, kNoon_us), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace ols::calibration
