#include "export/asterix/track_numbers.h"

#include <gtest/gtest.h>

namespace ols::exports {
namespace {

TEST(TrackNumbers, AreTheFusionsUnlessTheyAreTaken) {
  TrackNumbers numbers;
  EXPECT_EQ(numbers.of("a", 7), 7);
  EXPECT_EQ(numbers.of("b", 7), 8);
  EXPECT_EQ(numbers.of("a", 7), 7);
  numbers.release("a");
  EXPECT_EQ(numbers.of("c", 7 + 65'536), 7);
  EXPECT_EQ(numbers.of("d", -1), 65'535);
  EXPECT_EQ(numbers.of("e", -1), 0);
}

}  // namespace
}  // namespace ols::exports
