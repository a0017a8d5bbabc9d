#include "tools/logger/list_placement.h"

#include <gtest/gtest.h>

namespace ols::logger {
namespace {

TEST(ListPlacement, AFileBeginsWithTheListInForce) {
  EXPECT_TRUE(list_goes_before(3, 3, 0));
  EXPECT_TRUE(list_goes_before(2, 3, 0)) << "even if it waited while the list changed";
  EXPECT_FALSE(list_goes_before(0, 0, 0)) << "there is none yet";
}

TEST(ListPlacement, ANewListStandsBeforeTheFirstMessageThatWasJudgedByIt) {
  EXPECT_FALSE(list_goes_before(3, 4, 3)) << "judged by the last one, and it waited since";
  EXPECT_TRUE(list_goes_before(4, 4, 3));
  EXPECT_FALSE(list_goes_before(4, 4, 4)) << "it is there";
}

TEST(ListPlacement, OfTwoChangesAtOnceTheLastIsWritten) {
  EXPECT_FALSE(list_goes_before(4, 5, 3));
  EXPECT_TRUE(list_goes_before(5, 5, 3));
}

}  // namespace
}  // namespace ols::logger
