#include "tools/ctl/cue_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::ctl {
namespace {

using testing::HasSubstr;

TEST(CueTable, HasARowForEachCue) {
  const std::string table =
      cue_table({{{"tak.a", "Anna", "waiting", 0, 1.25, 49.2, 16.6, 400.0, 5.0, 9.0},
                  {"adsb.3c6444", "", "found", 7, 0.5, 49.3, 16.7, 900.0, 3.0, 4.0}},
                 0.0});
  EXPECT_THAT(table, HasSubstr("tak.a                waiting         -     1.2      49.200000"));
  EXPECT_THAT(table, HasSubstr("Anna\n"));
  EXPECT_THAT(table, HasSubstr("adsb.3c6444          found           7     0.5      49.300000"));
}

TEST(CueTable, SaysThatThereAreNone) { EXPECT_EQ(cue_table({}), "no cues\n"); }

}  // namespace
}  // namespace ols::ctl
