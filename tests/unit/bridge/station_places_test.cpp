#include "bridge/station_places.h"

#include <gtest/gtest.h>

#include <string>

namespace ols::bridge {
namespace {

constexpr double kHeard_s = 100.0;

TEST(StationPlaces, ANameBelongsToItsPlaceUntilItFallsSilent) {
  StationPlaces places;
  EXPECT_TRUE(places.settle("alfa", "r", "brno", kHeard_s));
  EXPECT_FALSE(places.settle("alfa", "r", "praha", kHeard_s + 1.0));
  EXPECT_TRUE(places.is_elsewhere("alfa", "r", "praha", kHeard_s + 1.0));
  EXPECT_FALSE(places.is_elsewhere("alfa", "r", "brno", kHeard_s + 1.0));
  EXPECT_TRUE(places.settle("alfa", "r", "praha", kHeard_s + StationPlaces::kSettled_s));
  ASSERT_NE(places.find("alfa"), nullptr);
  EXPECT_EQ(places.find("alfa")->site, "praha");
  EXPECT_EQ(places.size(), 1U);
}

TEST(StationPlaces, InventedNamesOfOneSiteTakeNoRoomOfOthers) {
  StationPlaces places;
  for (std::size_t i = 0; i < 2 * StationPlaces::kMostOfSite; ++i) {
    places.settle("invented" + std::to_string(i), "r", "brno", kHeard_s);
  }
  EXPECT_EQ(places.size(), StationPlaces::kMostOfSite);
  EXPECT_TRUE(places.settle("alfa", "r", "praha", kHeard_s));
  EXPECT_TRUE(places.settle("invented0", "r", "brno", kHeard_s + 30.0)) << "it is there already";
  EXPECT_TRUE(places.settle("bravo", "r", "brno", kHeard_s + StationPlaces::kSettled_s + 1.0))
      << "the silent ones are forgotten";
  EXPECT_EQ(places.size(), 2U) << "invented0, which was heard since, and bravo";
}

TEST(StationPlaces, ASiteIsHeardWithItsLatestStation) {
  StationPlaces places;
  places.settle("alfa", "r", "brno", kHeard_s);
  places.settle("bravo", "r", "brno", kHeard_s + 4.0);
  EXPECT_NEAR(places.sites_ago_s(kHeard_s + 5.0).at("brno"), 1.0, 1e-9);
  EXPECT_TRUE(places.sites_ago_s(kHeard_s + 2.0 * StationPlaces::kSettled_s).empty());
}

}  // namespace
}  // namespace ols::bridge
