#include "console/connection_limit.h"

#include <gtest/gtest.h>

#include <vector>

namespace ols::console {
namespace {

TEST(ConnectionLimit, OneAddressCannotUseUpWhatAllShare) {
  ConnectionLimit limit;
  std::vector<ConnectionLimit::Place> greedy;
  for (std::size_t i = 0; i < ConnectionLimit::kMostOfOne; ++i) {
    greedy.push_back(limit.admit("10.0.0.1"));
    EXPECT_TRUE(greedy.back());
  }
  EXPECT_FALSE(limit.admit("10.0.0.1"));
  EXPECT_TRUE(limit.admit("10.0.0.2"));
  greedy.pop_back();
  EXPECT_TRUE(limit.admit("10.0.0.1")) << "one has ended";
}

TEST(ConnectionLimit, AllTogetherAreBounded) {
  ConnectionLimit limit;
  std::vector<ConnectionLimit::Place> places;
  for (std::size_t i = 0; i < ConnectionLimit::kMost; ++i) {
    places.push_back(limit.admit("10.0.0." + std::to_string(i)));
    EXPECT_TRUE(places.back());
  }
  EXPECT_FALSE(limit.admit("10.1.0.1"));
  places.clear();
  EXPECT_TRUE(limit.admit("10.1.0.1"));
}

}  // namespace
}  // namespace ols::console
