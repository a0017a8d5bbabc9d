#include "bridge/station_places.h"

#include <gtest/gtest.h>

#include <string>

namespace ols::bridge {
namespace {

constexpr double kHeard_s = 100.0;

TEST(StationPlaces, ANameBelongsToItsPlaceUntilItFallsSilent) {
  StationPlaces book;
  EXPECT_TRUE(book.settle("alfa", "r", "brno", kHeard_s));
  EXPECT_FALSE(book.settle("alfa", "r", "praha", kHeard_s + 1.0));
  EXPECT_TRUE(book.is_elsewhere("alfa", "r", "praha", kHeard_s + 1.0));
  EXPECT_FALSE(book.is_elsewhere("alfa", "r", "brno", kHeard_s + 1.0));
  EXPECT_TRUE(book.settle("alfa", "r", "praha", kHeard_s + StationPlaces::kSettled_s));
  ASSERT_NE(book.find("alfa"), nullptr);
  EXPECT_EQ(book.find("alfa")->site, "praha");
  EXPECT_EQ(book.size(), 1U);
}

TEST(StationPlaces, InventedNamesOfOneSiteTakeNoRoomOfOthers) {
  StationPlaces book;
  for (std::size_t i = 0; i < 2 * StationPlaces::kMostOfSite; ++i) {
    book.settle("invented" + std::to_string(i), "r", "brno", kHeard_s);
  }
  EXPECT_EQ(book.size(), StationPlaces::kMostOfSite);
  EXPECT_TRUE(book.settle("alfa", "r", "praha", kHeard_s));
  EXPECT_TRUE(book.settle("invented0", "r", "brno", kHeard_s + 30.0)) << "it is there already";
  EXPECT_TRUE(book.settle("bravo", "r", "brno", kHeard_s + StationPlaces::kSettled_s + 1.0))
      << "the silent ones are forgotten";
  EXPECT_EQ(book.size(), 2U) << "invented0, which was heard since, and bravo";
}

TEST(StationPlaces, ASiteIsHeardWithItsLatestStation) {
  StationPlaces book;
  book.settle("alfa", "r", "brno", kHeard_s);
  book.settle("bravo", "r", "brno", kHeard_s + 4.0);
  EXPECT_NEAR(book.sites_ago_s(kHeard_s + 5.0).at("brno"), 1.0, 1e-9);
  EXPECT_TRUE(book.sites_ago_s(kHeard_s + 2.0 * StationPlaces::kSettled_s).empty());
}

}  // namespace
}  // namespace ols::bridge
