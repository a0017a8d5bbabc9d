#include "bridge/ownership/owner_record.h"

#include <gtest/gtest.h>

namespace ols::bridge {
namespace {

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
