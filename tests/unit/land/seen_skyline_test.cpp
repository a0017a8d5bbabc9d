#include "land/seen_skyline.h"

#include <gtest/gtest.h>

namespace ols::land {
namespace {

const SeenCrest kCrest{
    .elevation_rad = 0.05, .sd_rad = 0.001, .hides_from_m = 400.0, .disagrees = true};

TEST(SeenSkyline, IsKnownAroundWhatHasBeenSeen) {
  SeenSkyline skyline;
  EXPECT_FALSE(skyline.at(0.0));
  skyline.set(0, kCrest);
  EXPECT_EQ(skyline.at(SeenSkyline::azimuth_rad(0)), kCrest);
  EXPECT_EQ(skyline.at(radians(0.12)), kCrest);
  EXPECT_EQ(skyline.at(radians(-0.08)), kCrest) << "across north";
  EXPECT_FALSE(skyline.at(radians(0.16)));
  EXPECT_FALSE(skyline.at(radians(-0.12)));
}

TEST(SeenSkyline, ASectorReplacesWhatWasSeenThere) {
  constexpr int kLast = SeenSkyline::kColumns - 1, kLastSector = SeenSkyline::kSectors - 1;
  SeenSkyline skyline;
  skyline.set(99, kCrest);
  skyline.set(100, kCrest);
  skyline.set(kLast, kCrest);
  EXPECT_EQ(skyline.count(), 3);
  EXPECT_EQ(skyline.sector(0).size(), 1U);
  EXPECT_EQ(skyline.sector(kLastSector).at(0).column, kLast);
  skyline.set_sector(0, std::vector<SeenSkyline::Column>{{7, kCrest}, {8, kCrest}, {100, kCrest}});
  EXPECT_EQ(skyline.sector(0).size(), 2U);
  EXPECT_EQ(skyline.sector(0).at(1).column, 8);
  EXPECT_EQ(skyline.count(), 4);
  skyline.remove(8);
  skyline.remove(9);
  EXPECT_EQ(skyline.count(), 3);
  for (int sector = 0; sector < SeenSkyline::kSectors; ++sector) skyline.set_sector(sector, {});
  EXPECT_TRUE(skyline.empty());
}

TEST(SeenSkyline, HidesWhatIsBeyondItAndNothingBefore) {
  const Skyline model{.elevation_rad = 0.01, .elevation_sd_rad = 0.004, .distance_m = 300.0};
  const double azimuth_rad = SeenSkyline::azimuth_rad(7);
  SeenSkyline skyline;
  EXPECT_EQ(skyline.hiding(model, azimuth_rad, 401.0).elevation_rad, 0.01) << "nothing is seen";
  skyline.set(7, kCrest);
  EXPECT_EQ(skyline.hiding(model, azimuth_rad, 399.0).elevation_rad, 0.01);
  const Skyline beyond = skyline.hiding(model, azimuth_rad, 401.0);
  EXPECT_EQ(beyond.elevation_rad, 0.05);
  EXPECT_EQ(beyond.elevation_sd_rad, 0.001);
  EXPECT_EQ(beyond.distance_m, 400.0);
  SeenCrest in_haze = kCrest;
  in_haze.hides_from_m = 0.0;
  skyline.set(7, in_haze);
  EXPECT_EQ(skyline.hiding(model, azimuth_rad, 1e4).elevation_rad, 0.01);
}

TEST(SeenSkyline, OnlyItsOwnColumnLowersTheModel) {
  const Skyline house{.elevation_rad = 0.2, .elevation_sd_rad = 0.004, .distance_m = 300.0};
  SeenSkyline skyline;
  skyline.set(7, kCrest);
  const auto at_column = [&](int column, const Skyline& model) {
    return skyline.hiding(model, SeenSkyline::azimuth_rad(column), 500.0).elevation_rad;
  };
  EXPECT_EQ(at_column(7, house), 0.05);
  EXPECT_EQ(at_column(8, house), 0.2);
  EXPECT_EQ(at_column(8, {.elevation_rad = 0.01, .distance_m = 300.0}), 0.05) << "but raises it";
}

}  // namespace
}  // namespace ols::land
