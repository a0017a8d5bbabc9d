#include "edge/skyline/skyline_part.h"

#include <gtest/gtest.h>

namespace ols::skyline {
namespace {

TEST(SkylineParts, AreTheSeenSectorsInTurn) {
  HidingSkyline skyline;
  skyline.begun_us = 17;
  for (const int column : {0, 99, 500, 7199}) skyline.crests.set(column, {0.1, 0.01, 100.0, true});
  SkylineParts parts;
  std::vector<int> sectors;
  std::size_t columns = 0;
  for (int i = 0; i < 6; ++i) {
    const SkylinePart part = parts.next(skyline, true);
    EXPECT_EQ(part.begun_us, 17);
    EXPECT_TRUE(part.heading_disagrees);
    sectors.push_back(part.sector);
    columns += part.columns.size();
  }
  EXPECT_EQ(sectors, (std::vector<int>{5, 71, 0, 5, 71, 0}));
  EXPECT_EQ(columns, 8U);
}

TEST(SkylineParts, NothingSeenIsSaid) {
  SkylineParts parts;
  const SkylinePart part = parts.next({}, false);
  EXPECT_EQ(part.begun_us, 0);
  EXPECT_TRUE(part.columns.empty());
}

}  // namespace
}  // namespace ols::skyline
