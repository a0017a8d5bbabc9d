#include "console/maps/tile_store.h"

#include <gtest/gtest.h>

#include <limits>

namespace ols::console {
namespace {

TEST(TileStore, AnAddressLiesWithinItsZoomLevel) {
  EXPECT_TRUE(is_address({0, 0, 0}));
  EXPECT_TRUE(is_address({3, 7, 7}));
  EXPECT_FALSE(is_address({3, 8, 0}));
  EXPECT_FALSE(is_address({3, 0, -1}));
  EXPECT_FALSE(is_address({25, 0, 0}));
}

TEST(TileStore, PicturesAreKnownByTheirFirstBytes) {
  EXPECT_EQ(picture_type("\x89PNG...."), "image/png");
  EXPECT_EQ(picture_type("\xff\xd8\xff\xe0"), "image/jpeg");
  EXPECT_EQ(picture_type("RIFF1234WEBPVP8 "), "image/webp");
  EXPECT_EQ(picture_type("<script>"), "");
  EXPECT_EQ(picture_type("RIFF"), "");
}

TEST(TileStore, WhatAFileSaysOfItselfIsBroughtIntoRange) {
  MapInfo info;
  info.name = std::string(1000, 'x') + "\x1b";
  info.min_zoom = -3;
  info.max_zoom = 99;
  info.bounds_deg = {10.0, 50.0, 5.0, std::numeric_limits<double>::quiet_NaN()};
  const MapInfo good = plausible(info);
  EXPECT_LE(good.name.size(), 200U);
  EXPECT_EQ(good.min_zoom, 0);
  EXPECT_EQ(good.max_zoom, kMostZoom);
  EXPECT_EQ(good.bounds_deg[0], -180.0);
}

}  // namespace
}  // namespace ols::console
