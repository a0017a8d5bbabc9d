#include "sim/network/network.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

Errors::Messages nothing_wrong() {
  Errors::Messages errors;
  errors.lost = errors.doubled = errors.late = 0.0;
  errors.delay_s = 0.01;
  return errors;
}

TEST(Network, DeliversInOrderAfterItsDelay) {
  Network<int> network(nothing_wrong(), 1);
  network.send(1, 0.0);
  network.send(2, 0.0);
  EXPECT_TRUE(network.receive(0.009).empty());
  EXPECT_EQ(network.receive(0.011), (std::vector<int>{1, 2}));
  EXPECT_TRUE(network.receive(1.0).empty());
}

TEST(Network, LosesDoublesAndDelaysAsOftenAsStated) {
  constexpr int kSent = 20000;
  Errors::Messages errors = nothing_wrong();
  errors.lost = 0.1;
  Network<int> losing(errors, 1);
  errors = nothing_wrong();
  errors.doubled = 0.1;
  Network<int> doubling(errors, 1);
  errors = nothing_wrong();
  errors.late = 0.1;
  Network<int> late(errors, 1);
  for (int i = 0; i < kSent; ++i) {
    losing.send(i, 0.0);
    doubling.send(i, 0.0);
    late.send(i, 0.0);
  }
  EXPECT_NEAR(losing.receive(9.0).size(), 0.9 * kSent, 200);
  EXPECT_NEAR(doubling.receive(9.0).size(), 1.1 * kSent, 200);
  EXPECT_NEAR(late.receive(0.05).size(), 0.9 * kSent, 200);
  EXPECT_NEAR(late.receive(0.5).size(), 0.1 * kSent, 200);
}

TEST(Network, SwitchedOffDoesNoHarm) {
  Errors::Messages errors;
  errors.on = false;
  errors.lost = errors.doubled = errors.late = 0.5;
  Network<int> network(errors, 1);
  for (int i = 0; i < 100; ++i) network.send(i, 0.0);
  EXPECT_EQ(network.receive(errors.delay_s).size(), 100U);
}

}  // namespace
}  // namespace ols::sim
