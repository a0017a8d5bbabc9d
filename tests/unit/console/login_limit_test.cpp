#include "console/login_limit.h"

#include <gtest/gtest.h>

#include <string>

namespace ols::console {
namespace {

TEST(LoginLimit, AFewTriesAtOnceThenSlowly) {
  LoginLimit limit;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(limit.admit("a", 0.0));
  EXPECT_FALSE(limit.admit("a", 0.0));
  EXPECT_TRUE(limit.admit("b", 0.0)) << "another address is not hurt";
  EXPECT_TRUE(limit.admit("a", LoginLimit::kRegained_s + 0.1));
  EXPECT_FALSE(limit.admit("a", LoginLimit::kRegained_s + 0.2));
}

TEST(LoginLimit, ManyAddressesTogetherAreSlowToo) {
  LoginLimit limit;
  int admitted = 0;
  for (int i = 0; i < 200; ++i) admitted += limit.admit(std::to_string(i), 0.0) ? 1 : 0;
  EXPECT_EQ(admitted, 50);
}

TEST(LoginLimit, IsBounded) {
  LoginLimit limit;
  for (std::size_t i = 0; i < LoginLimit::kMostAddresses; ++i) limit.admit(std::to_string(i), 0.0);
  EXPECT_FALSE(limit.admit("another", 10.0));
  EXPECT_TRUE(limit.admit("another", 100.0)) << "the others are forgotten";
}

}  // namespace
}  // namespace ols::console
