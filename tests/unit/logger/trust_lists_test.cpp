#include "tools/logger/trust_lists.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ols::logger {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class TrustListsTest : public testing::Test {
 protected:
  TrustListsTest() {
    for (const std::int64_t number : {3, 4, 5}) lists_.add({number, std::to_string(number)});
  }
  std::vector<std::int64_t> due(std::int64_t judged_by, std::int64_t written) {
    std::vector<std::int64_t> numbers;
    for (const ReceivedList& list : lists_.due(judged_by, written)) {
      EXPECT_EQ(list.text, std::to_string(list.number));
      numbers.push_back(list.number);
    }
    return numbers;
  }
  TrustLists lists_;
};

TEST_F(TrustListsTest, AFileBeginsWithTheListThatItsFirstMessageWasJudgedBy) {
  EXPECT_THAT(due(3, 0), ElementsAre(3)) << "although two later ones are known";
}

TEST_F(TrustListsTest, WhatWaitedWhileTheListChangedStaysBeforeTheNewOne) {
  EXPECT_THAT(due(3, 3), IsEmpty());
  EXPECT_THAT(due(4, 3), ElementsAre(4));
}

TEST_F(TrustListsTest, OfTwoChangesBothAreWrittenInOrder) {
  EXPECT_THAT(due(5, 3), ElementsAre(4, 5));
}

TEST_F(TrustListsTest, TheNextFileBeginsWithTheLastOne) {
  EXPECT_THAT(due(5, 0), ElementsAre(5));
  EXPECT_THAT(due(5, 5), IsEmpty());
  EXPECT_THAT(due(5, 0), ElementsAre(5));
}

TEST_F(TrustListsTest, AMessageThatWasJudgedByNoListNeedsNone) {
  EXPECT_THAT(due(0, 0), IsEmpty());
  TrustLists none;
  EXPECT_EQ(none.newest(), 0);
  EXPECT_THAT(none.due(7, 0), IsEmpty());
}

TEST_F(TrustListsTest, AnOlderListIsNotAdded) {
  EXPECT_EQ(lists_.newest(), 5);
  lists_.add({4, "another"});
  EXPECT_EQ(lists_.newest(), 5);
  EXPECT_THAT(due(5, 0), ElementsAre(5));
}

}  // namespace
}  // namespace ols::logger
