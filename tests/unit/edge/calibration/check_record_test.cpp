#include "edge/calibration/check_record.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

constexpr double kHour_s = 3600.0;

TEST(CheckRecord, ANightIsNothingToSayADayIs) {
  CheckRecord record;
  record.note(100.0);
  record.note_unrecognised();
  record.note(100.0 + 16 * kHour_s);
  EXPECT_EQ(record.alarm(), "");
  record.note(100.0 + 25 * kHour_s);
  EXPECT_EQ(record.alarm(),
            "calibration: not checked for 25.0 h: its reference views are not recognised");
  record.note_judged();
  EXPECT_EQ(record.alarm(), "");
  record.note(100.0 + 50 * kHour_s);
  EXPECT_NE(record.alarm().text.find("never idle"), std::string::npos);
}

TEST(CheckRecord, ADayInWhichTheSunStoodInTheViewsIsSaid) {
  CheckRecord record;
  record.note(0.0);
  record.note_sun();
  record.note(25 * kHour_s);
  EXPECT_NE(record.alarm().text.find("the sun stands in its reference views"), std::string::npos);
}

TEST(CheckRecord, AUnitThatDoesNotArriveIsSaidAfterThreeRounds) {
  CheckRecord record;
  record.note(0.0);
  record.note_late(2);
  EXPECT_EQ(record.alarm(), "");
  record.note_late(3);
  EXPECT_NE(record.alarm().text.find("the unit does not come to its reference views"),
            std::string::npos);
  record.note_late(0);
  EXPECT_EQ(record.alarm(), "");
}

TEST(CheckRecord, TooFewViewsAreSaidAtOnce) {
  CheckRecord record;
  record.note_too_few();
  EXPECT_NE(record.alarm().text.find("fewer than three"), std::string::npos);
}

}  // namespace
}  // namespace ols::station
