#include "base/trust/station_boots.h"

#include <gtest/gtest.h>

namespace ols::trust {
namespace {

TEST(StationBoots, KnowsTheBootOfTheLastStatus) {
  StationBoots boots;
  EXPECT_EQ(boots.boot_of("alfa"), 0);
  boots.hear("alfa", 7, true, 100.0);
  boots.hear("bravo", 8, true, 100.0);
  EXPECT_EQ(boots.boot_of("alfa"), 7);
  boots.hear("alfa", 9, true, 101.0);
  EXPECT_EQ(boots.boot_of("alfa"), 9) << "it was restarted";
  EXPECT_EQ(boots.boot_of("bravo"), 8);
}

TEST(StationBoots, ARecordingDoesNotHideALiveStation) {
  StationBoots boots;
  boots.hear("alfa", 7, true, 100.0);
  boots.hear("alfa", 3, false, 104.9);
  EXPECT_EQ(boots.boot_of("alfa"), 7);
  boots.hear("alfa", 3, false, 119.9);
  EXPECT_EQ(boots.boot_of("alfa"), 7);
  boots.hear("alfa", 3, false, 120.1);
  EXPECT_EQ(boots.boot_of("alfa"), 3) << "its host may have lost its clock when it booted";
}

TEST(StationBoots, BesideFreshStatusesTheOthersAreNotAStationsOwn) {
  StationBoots boots;
  EXPECT_TRUE(boots.may_be_own("alfa", 7, 100.0));
  boots.hear("alfa", 7, true, 100.0);
  EXPECT_FALSE(boots.may_be_own("alfa", 7, 104.9));
  EXPECT_TRUE(boots.may_be_own("alfa", 7, 105.1)) << "its clock may have become wrong";
  EXPECT_FALSE(boots.may_be_own("alfa", 3, 105.1)) << "of another boot";
  EXPECT_TRUE(boots.may_be_own("bravo", 3, 100.0));
}

TEST(StationBoots, AStationThatNeverHadARightClockIsKnown) {
  StationBoots boots;
  boots.hear("alfa", 3, false, 0.0);
  EXPECT_EQ(boots.boot_of("alfa"), 3);
}

}  // namespace
}  // namespace ols::trust
