#include "central/admission/image_assembly.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

BearingMeasurement of(const std::string& station, std::int64_t utime_us, int image_bearings) {
  BearingMeasurement measurement;
  measurement.station = station;
  measurement.utime_us = utime_us;
  measurement.image_bearings = image_bearings;
  return measurement;
}

TEST(ImageAssembly, ABearingThatStatesNoImageIsOne) {
  ImageAssembly images;
  EXPECT_EQ(images.add(of("a", 1, 0), 1).size(), 1U);
  EXPECT_EQ(images.add(of("a", 1, 0), 1).size(), 1U);
}

TEST(ImageAssembly, AnImageIsCompleteWithItsLastBearing) {
  ImageAssembly images;
  EXPECT_TRUE(images.add(of("a", 1, 3), 1).empty());
  EXPECT_TRUE(images.add(of("b", 1, 2), 1).empty());
  EXPECT_TRUE(images.add(of("a", 1, 3), 1).empty());
  const auto complete = images.add(of("a", 1, 3), 1);
  ASSERT_EQ(complete.size(), 1U);
  EXPECT_EQ(complete[0].size(), 3U);
  EXPECT_EQ(images.add(of("b", 1, 2), 1).size(), 1U);
}

TEST(ImageAssembly, ALostBearingIsNotWaitedForBeyondTheNextImage) {
  ImageAssembly images;
  images.add(of("a", 1, 2), 1);
  const auto complete = images.add(of("a", 30'000, 1), 30'000);
  ASSERT_EQ(complete.size(), 2U);
  EXPECT_EQ(complete[0].front().utime_us, 1);
  EXPECT_EQ(complete[1].front().utime_us, 30'000);
}

TEST(ImageAssembly, BehindARollingShutterEachBearingHasTheTimeOfItsRow) {
  ImageAssembly images;
  const auto seen = [](std::int64_t utime_us, std::int64_t track_id) {
    BearingMeasurement measurement = of("a", utime_us, 3);
    measurement.track_id = track_id;
    return measurement;
  };
  EXPECT_TRUE(images.add(seen(20'000, 1), 20'000).empty());
  EXPECT_TRUE(images.add(seen(1'000, 2), 20'000).empty());
  const auto complete = images.add(seen(35'000, 3), 35'000);
  ASSERT_EQ(complete.size(), 1U);
  EXPECT_EQ(complete[0].size(), 3U);
  images.add(seen(120'000, 1), 120'000);
  EXPECT_EQ(images.add(seen(150'000, 1), 150'000).at(0).size(), 1U) << "the next image of it";
}

TEST(ImageAssembly, ALostBearingOfAStationThatFallsSilentIsNotWaitedForLong) {
  ImageAssembly images;
  images.add(of("a", 1, 2), 1);
  EXPECT_EQ(images.add(of("b", 50'000, 0), 50'000).size(), 1U);
  const auto complete = images.add(of("b", 60'000, 0), 60'000);
  ASSERT_EQ(complete.size(), 2U);
  EXPECT_EQ(complete[0].front().station, "a");
}

}  // namespace
}  // namespace ols::fusion
