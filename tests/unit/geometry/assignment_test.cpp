#include "geometry/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace ols {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// By trying all; -1 for the columns beyond the last one.
double least_by_trial(const Eigen::MatrixXd& cost, double unassigned) {
  const auto columns = static_cast<int>(cost.cols() + cost.rows());
  std::vector<int> order(static_cast<std::size_t>(columns));
  std::iota(order.begin(), order.end(), 0);
  double least = kNever;
  do {
    std::vector<int> some(order.begin(), order.begin() + cost.rows());
    for (int& column : some) column = column < cost.cols() ? column : -1;
    least = std::min(least, cost_of(some, cost, unassigned));
  } while (std::ranges::next_permutation(order).found);
  return least;
}

TEST(Assignment, CostsAsLittleAsTheBestOfAll) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(0.0, 1.0);
  for (int run = 0; run < 60; ++run) {
    Eigen::MatrixXd cost(1 + run % 4, run % 5);
    for (double& value : cost.reshaped()) value = draw(random) < 0.3 ? kNever : draw(random);
    const std::vector<int> found = assign(cost, 0.7);
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) EXPECT_TRUE(found[i] < 0 || found[i] != found[k]);
    }
    EXPECT_NEAR(cost_of(found, cost, 0.7), least_by_trial(cost, 0.7), 1e-12) << "run " << run;
  }
}

TEST(Assignment, GivesUpTheNearestForTheSum) {
  const Eigen::MatrixXd cost{{1.0, 2.0}, {3.0, 9.0}};
  EXPECT_EQ(assign(cost, 25.0), (std::vector{1, 0}));
}

TEST(Assignment, LeavesARowThatNothingFits) {
  const Eigen::MatrixXd cost{{kNever, 30.0}, {kNever, 2.0}};
  EXPECT_EQ(assign(cost, 25.0), (std::vector{-1, 1}));
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3), 25.0).empty());
}

}  // namespace
}  // namespace ols
