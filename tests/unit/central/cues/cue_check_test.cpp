#include "central/cues/cue_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/unit/central/cues/cue_scene.h"

namespace ols::fusion {
namespace {

using test::cue_at;
using test::good_cue;
using test::kCueTime_us;

CueRefusal checked(const Cue& cue, std::int64_t present_us = kCueTime_us) {
  return check(cue, present_us, {});
}

TEST(CueCheck, AGoodOneIsTaken) { EXPECT_EQ(checked(good_cue()), CueRefusal::kNone); }

TEST(CueCheck, NothingThatIsNotFinitePasses) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (double Cue::*field : {&Cue::horizontal_sd_m, &Cue::vertical_sd_m, &Cue::velocity_sd_m_s}) {
      Cue cue = good_cue();
      cue.*field = bad;
      EXPECT_EQ(checked(cue), CueRefusal::kNotFinite);
    }
    EXPECT_EQ(checked(cue_at(bad, 16.6, 400.0)), CueRefusal::kNotFinite);
    EXPECT_EQ(checked(cue_at(49.2, bad, 400.0)), CueRefusal::kNotFinite);
    EXPECT_EQ(checked(cue_at(49.2, 16.6, bad)), CueRefusal::kNotFinite);
    Cue cue = good_cue();
    cue.velocity_enu_m_s.z() = bad;
    EXPECT_EQ(checked(cue), CueRefusal::kNotFinite);
  }
}

TEST(CueCheck, ThePoleAndWhatCannotBeAreNamed) {
  EXPECT_EQ(checked(cue_at(90.0, 0.0, 0.0)), CueRefusal::kPole);
  EXPECT_EQ(checked(cue_at(-89.95, 0.0, 0.0)), CueRefusal::kPole);
  EXPECT_EQ(checked(cue_at(90.1, 0.0, 0.0)), CueRefusal::kOutOfRange);
  EXPECT_EQ(checked(cue_at(49.2, 181.0, 0.0)), CueRefusal::kOutOfRange);
  EXPECT_EQ(checked(cue_at(49.2, 16.6, 1e6)), CueRefusal::kOutOfRange);
  Cue cue = good_cue();
  cue.id.clear();
  EXPECT_EQ(checked(cue), CueRefusal::kOutOfRange);
  cue = good_cue();
  cue.vertical_sd_m = 0.0;
  EXPECT_EQ(checked(cue), CueRefusal::kOutOfRange);
  cue = good_cue();
  cue.velocity_enu_m_s.x() = 1e5;
  EXPECT_EQ(checked(cue), CueRefusal::kOutOfRange);
  cue = good_cue();
  cue.horizontal_sd_m = 2001.0;
  EXPECT_EQ(checked(cue), CueRefusal::kVague);
}

TEST(CueCheck, OldAndFutureOnesAreRefusedWhateverTheirStamps) {
  Cue cue = good_cue();
  cue.state_us = kCueTime_us - 9'900'000;
  EXPECT_EQ(checked(cue), CueRefusal::kNone);
  cue.state_us = kCueTime_us - 10'100'000;
  EXPECT_EQ(checked(cue), CueRefusal::kStale);
  EXPECT_EQ(checked(good_cue(), kCueTime_us - 1'100'000), CueRefusal::kFuture);
  cue = good_cue();
  cue.utime_us = kCueTime_us - 1'100'000;  // a message that was kept, of a place that is new
  EXPECT_EQ(checked(cue), CueRefusal::kStale);
  for (std::int64_t Cue::*stamp : {&Cue::utime_us, &Cue::state_us}) {
    for (const std::int64_t absurd : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                                      std::numeric_limits<std::int64_t>::max()}) {
      cue = good_cue();
      cue.*stamp = absurd;
      EXPECT_EQ(checked(cue), CueRefusal::kOutOfRange) << "also where it is the present";
      EXPECT_EQ(checked(cue, absurd), CueRefusal::kOutOfRange);
    }
  }
}

TEST(CueCheck, TheSitesAreaIsWhereItsStationsAre) {
  const StationRegistry stations = test::one_station();
  EXPECT_TRUE(is_in_area(good_cue(), stations, 301.0));
  EXPECT_FALSE(is_in_area(good_cue(), stations, 299.0));
  StationRegistry unplaced({}, 10);
  MessageTime time;
  unplaced.for_status("alfa", time);
  EXPECT_FALSE(is_in_area(good_cue(), unplaced, 1e9)) << "nobody knows where it stands";
}

TEST(CueCheck, EachRefusalHasACounterOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < static_cast<int>(CueRefusal::kCount); ++i) {
    names.insert(to_string(static_cast<CueRefusal>(i)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(CueRefusal::kCount));
}

}  // namespace
}  // namespace ols::fusion
