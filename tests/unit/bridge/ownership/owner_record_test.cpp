#include "bridge/ownership/owner_record.h"

#include <gtest/gtest.h>

#include "bridge/ownership/cell.h"

namespace ols::bridge {
namespace {

constexpr Cell kCell{49.0, 16.0, 50.0, 17.0};

TEST(Cell, DepthIsTheDistanceToTheNearestBorder) {
  EXPECT_NEAR(depth_m(kCell, 49.1, 16.5), 11'119.5, 1.0);
  EXPECT_NEAR(depth_m(kCell, 49.5, 16.1), 7'222.0, 10.0);
  EXPECT_NEAR(depth_m(kCell, 48.9, 16.5), -11'119.5, 1.0);
  EXPECT_NEAR(depth_m(kCell, 49.5, 17.1), -7'222.0, 10.0);
  EXPECT_NEAR(depth_m(kCell, 49.5, 15.9), -7'222.0, 10.0);
}

TEST(Cell, TheWholeWorldHasNoSides) {
  EXPECT_GT(depth_m({-90.0, -180.0, 90.0, 180.0}, 49.0, 179.9999), 1e6);
}

TEST(Cell, MayLieAcrossTheDateLine) {
  const Cell cell{-20.0, 179.0, -10.0, -179.0};
  EXPECT_GT(depth_m(cell, -15.0, 180.0), 1e5);
  EXPECT_GT(depth_m(cell, -15.0, -179.5), 5e4);
  EXPECT_LT(depth_m(cell, -15.0, 178.0), 0.0);
  EXPECT_LT(depth_m(cell, -15.0, -178.0), 0.0);
}

TEST(OwnerRecord, IsReadAsItWasWritten) {
  const OwnerRecord record{"north:7", "south:8", 3, 1'700'000'000'000'000, {1, 2, 3}, {4, 5, 6}, 7};
  const auto read = parse_record(to_text(record));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->owner, record.owner);
  EXPECT_EQ(read->successor, record.successor);
  EXPECT_EQ(read->beat, 3);
  EXPECT_EQ(read->utime_us, record.utime_us);
  EXPECT_EQ(read->position_m, record.position_m);
  EXPECT_EQ(read->velocity_m_s, record.velocity_m_s);
  EXPECT_EQ(read->sd_m, 7.0);
}

TEST(OwnerRecord, NothingElseIsOne) {
  for (const char* text :
       {"", "rubbish", "[]", "{}", R"({"owner": 1})",
        R"({"owner":"a","successor":"","beat":1,"utime":1,"position_m":[1,2],)"
        R"("velocity_m_s":[1,2,3],"sd_m":1})",
        R"({"owner":"a","successor":"","beat":1,"utime":1,"position_m":[1e300,2,3],)"
        R"("velocity_m_s":[1,2,3],"sd_m":1})",
        R"({"owner":"a","successor":"","beat":1,"utime":1,"position_m":[1,2,null],)"
        R"("velocity_m_s":[1,2,3],"sd_m":1})",
        R"({"owner":"a","successor":"","beat":1,"utime":1,"position_m":[1,2,3],)"
        R"("velocity_m_s":[1,2,3],"sd_m":-1})"}) {
    EXPECT_FALSE(parse_record(text)) << text;
  }
}

}  // namespace
}  // namespace ols::bridge
