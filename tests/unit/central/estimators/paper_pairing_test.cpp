#include "central/estimators/paper_pairing.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace ols::fusion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Views of nearly the same point, whose rays miss each other by about a metre, with different
// beliefs.
std::vector<PaperView> views(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector3d(normal(random), normal(random), normal(random)); };
  std::vector<PaperView> all;
  for (int i = 0; i < count; ++i) {
    const Vector3d centre = 100.0 * draw();
    const Vector3d through = Vector3d(40, 500, 200) + draw();
    all.push_back({centre, (through - centre).normalized(), 0.1 + 0.2 * i});
  }
  return all;
}

// d position / d direction, across it, by central differences of the whole estimator.
Matrix3d by_differences(std::vector<PaperView> all, std::size_t index, const PaperConfig& config) {
  constexpr double kStep = 1e-6;
  const Vector3d direction = all[index].direction_ecef;
  Matrix3d derivative;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d across = Vector3d::Unit(axis) - direction(axis) * direction;
    all[index].direction_ecef = (direction + kStep * across).normalized();
    const Vector3d ahead = paper_n_view(all, config).position_ecef;
    all[index].direction_ecef = (direction - kStep * across).normalized();
    derivative.col(axis) = (ahead - paper_n_view(all, config).position_ecef) / (2.0 * kStep);
  }
  return derivative;
}

TEST(PaperPairing, DerivativesAreThoseOfTheEstimator) {
  for (const PaperPairs pairs :
       {PaperPairs::kAlgorithm1, PaperPairs::kCentroid, PaperPairs::kBestBaseline}) {
    for (const bool by_belief : {true, false}) {
      for (const int count : {2, 3, 6}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
          SCOPED_TRACE(std::to_string(count) + " views, seed " + std::to_string(seed));
          const PaperConfig config{.pairs = pairs, .by_belief = by_belief};
          const auto all = views(count, seed);
          const PaperPairing pairing = pair_views(all, config);
          ASSERT_EQ(pairing.solution, Solution::kOk);
          const auto derivatives = derivatives_by_direction(all, pairing, config);
          ASSERT_EQ(derivatives.size(), all.size());
          for (std::size_t i = 0; i < all.size(); ++i) {
            const Vector3d d = all[i].direction_ecef;
            const Matrix3d across = derivatives[i] * (Matrix3d::Identity() - d * d.transpose());
            const Matrix3d expected = by_differences(all, i, config);
            EXPECT_LT((across - expected).norm(), 1e-4 + 1e-5 * expected.norm());
          }
        }
      }
    }
  }
}

TEST(PaperPairing, SharesAddUpToOne) {
  for (const PaperPairs pairs :
       {PaperPairs::kAlgorithm1, PaperPairs::kCentroid, PaperPairs::kBestBaseline}) {
    const PaperPairing pairing = pair_views(views(5, 1), {.pairs = pairs});
    double sum = 0.0;
    for (const PaperBase& base : pairing.bases) sum += base.share;
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace ols::fusion
