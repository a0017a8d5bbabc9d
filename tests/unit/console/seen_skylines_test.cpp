#include "console/seen_skylines.h"

#include <gtest/gtest.h>

#include "geometry/angles.h"

namespace ols::console {
namespace {

TEST(ConsoleSeenSkylines, SectorsReplaceEachOtherUntilAnotherSkylineBegins) {
  SeenSkylines skylines;
  EXPECT_EQ(skylines.of("a"), (Json{{"differing", Json::array()}}));
  skylines.receive({"a", 1, 0, {{7, radians(2.5)}}});
  skylines.receive({"a", 1, 71, {{7199, radians(-1.0)}}});
  skylines.receive({"b", 1, 0, {}});
  EXPECT_EQ(skylines.of("a"), Json::parse(R"({"differing": [[0.375, 2.5], [359.975, -1.0]]})"));
  skylines.receive({"a", 1, 0, {{8, radians(3.0)}}});
  EXPECT_EQ(skylines.of("a"), Json::parse(R"({"differing": [[0.425, 3.0], [359.975, -1.0]]})"));
  skylines.receive({"a", 2, 1, {}});
  EXPECT_EQ(skylines.of("a"), (Json{{"differing", Json::array()}}));
}

}  // namespace
}  // namespace ols::console
