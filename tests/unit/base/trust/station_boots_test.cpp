#include "base/trust/station_boots.h"

#include <gtest/gtest.h>

namespace ols::trust {
namespace {

TEST(StationBoots, KnowsTheBootOfTheLastStatus) {
  StationBoots book;
  EXPECT_EQ(book.boot_of("alfa"), 0);
  book.hear("alfa", 7, true, 100.0);
  book.hear("bravo", 8, true, 100.0);
  EXPECT_EQ(book.boot_of("alfa"), 7);
  book.hear("alfa", 9, true, 101.0);
  EXPECT_EQ(book.boot_of("alfa"), 9) << "it was restarted";
  EXPECT_EQ(book.boot_of("bravo"), 8);
}

TEST(StationBoots, ARecordingDoesNotHideALiveStation) {
  StationBoots book;
  book.hear("alfa", 7, true, 100.0);
  book.hear("alfa", 3, false, 104.9);
  EXPECT_EQ(book.boot_of("alfa"), 7);
  book.hear("alfa", 3, false, 119.9);
  EXPECT_EQ(book.boot_of("alfa"), 7);
  book.hear("alfa", 3, false, 120.1);
  EXPECT_EQ(book.boot_of("alfa"), 3) << "its host may have lost its clock when it booted";
}

TEST(StationBoots, BesideFreshStatusesTheOthersAreNotAStationsOwn) {
  StationBoots book;
  EXPECT_TRUE(book.may_be_own("alfa", 7, 100.0));
  book.hear("alfa", 7, true, 100.0);
  EXPECT_FALSE(book.may_be_own("alfa", 7, 104.9));
  EXPECT_TRUE(book.may_be_own("alfa", 7, 105.1)) << "its clock may have become wrong";
  EXPECT_FALSE(book.may_be_own("alfa", 3, 105.1)) << "of another boot";
  EXPECT_TRUE(book.may_be_own("bravo", 3, 100.0));
}

TEST(StationBoots, AStationThatNeverHadARightClockIsKnown) {
  StationBoots book;
  book.hear("alfa", 3, false, 0.0);
  EXPECT_EQ(book.boot_of("alfa"), 3);
}

}  // namespace
}  // namespace ols::trust
