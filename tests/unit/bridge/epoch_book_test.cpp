#include "bridge/epoch_book.h"

#include <gtest/gtest.h>

namespace ols::bridge {
namespace {

TEST(EpochBook, OfOneTargetOnlyTheGreatestIsObeyedEver) {
  EpochBook book;
  EXPECT_TRUE(book.passes("alfa", "t", 5, 0.0));
  EXPECT_TRUE(book.passes("alfa", "t", 6, 0.1));
  EXPECT_FALSE(book.passes("alfa", "t", 5, 0.2));
  EXPECT_FALSE(book.passes("alfa", "t", 5, 1000.0));
  EXPECT_TRUE(book.passes("alfa", "t", 6, 1001.0));
}

TEST(EpochBook, AnotherTargetsLowerEpochWaitsUntilTheGreatestIsSilent) {
  EpochBook book;
  EXPECT_TRUE(book.passes("alfa", "new", 9, 0.0));
  EXPECT_FALSE(book.passes("alfa", "old", 4, EpochBook::kSilence_s));
  EXPECT_TRUE(book.passes("bravo", "old", 4, 0.1)) << "each station has its own";
  EXPECT_TRUE(book.passes("alfa", "old", 4, EpochBook::kSilence_s + 0.1));
  EXPECT_TRUE(book.passes("alfa", "new", 9, EpochBook::kSilence_s + 0.2));
}

TEST(EpochBook, TheGreatestIsThatOfWhatPassed) {
  EpochBook book;
  EXPECT_EQ(book.greatest(), 0U);
  EXPECT_TRUE(book.passes("alfa", "new", 9, 0.0));
  EXPECT_TRUE(book.passes("bravo", "old", 4, 0.1));
  EXPECT_FALSE(book.passes("alfa", "new", 8, 0.2));
  EXPECT_EQ(book.greatest(), 9U);
}

TEST(EpochBook, WhoOwnsNothingWaitsForOwners) {
  EpochBook book;
  EXPECT_TRUE(book.passes("alfa", "", 0, 0.0));
  EXPECT_TRUE(book.passes("alfa", "t", 1, 0.1));
  EXPECT_FALSE(book.passes("alfa", "", 0, 0.2));
  EXPECT_TRUE(book.passes("alfa", "", 0, 0.2 + EpochBook::kSilence_s));
}

TEST(EpochBook, ManyTargetsAreForgottenFromTheOldest) {
  EpochBook book;
  for (std::uint64_t epoch = 1; epoch <= 1002; ++epoch) {
    const std::string target = std::string("t").append(std::to_string(epoch));
    EXPECT_TRUE(book.passes("alfa", target, epoch, 0.0));
  }
  EXPECT_FALSE(book.passes("alfa", "t1002", 1001, 10.0)) << "the newest are kept";
}

}  // namespace
}  // namespace ols::bridge
