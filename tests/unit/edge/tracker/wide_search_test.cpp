#include "edge/tracker/wide_search.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace ols::tracker {
namespace {

constexpr double kStep_px = 30.0;
constexpr int kAcross = 2 * WideSearch::kRings + 1;
constexpr int kRound = (kAcross * kAcross + WideSearch::kPlaces - 1) / WideSearch::kPlaces;
const Eigen::Vector2d kMiddle(320.0, 240.0);
const cv::Size kFrame(640, 480);

double rings_away(const Eigen::Vector2d& place) {
  return (place - kMiddle).cwiseAbs().maxCoeff() / kStep_px;
}

TEST(WideSearch, LooksEverywhereOnceFromTheInsideOutwards) {
  WideSearch search;
  std::set<std::pair<double, double>> seen;
  double ring = 0.0;
  for (int k = 0; k < kAcross * kAcross / WideSearch::kPlaces; ++k) {
    const auto places = search.next(kMiddle, kStep_px, kFrame);
    ASSERT_EQ(places.size(), static_cast<std::size_t>(WideSearch::kPlaces));
    for (const Eigen::Vector2d& place : places) {
      EXPECT_TRUE(seen.emplace(place.x(), place.y()).second);
      EXPECT_GE(rings_away(place), ring);
      ring = rings_away(place);
    }
  }
  EXPECT_EQ(ring, WideSearch::kRings);
}

TEST(WideSearch, BeginsAgain) {
  WideSearch search;
  bool again = false;
  for (int k = 0; k < kRound + 1; ++k) {
    for (const Eigen::Vector2d& place : search.next(kMiddle, kStep_px, kFrame)) {
      again = again || (k > 0 && rings_away(place) == 0.0);
    }
  }
  EXPECT_TRUE(again);
}

TEST(WideSearch, StaysInsideTheFrame) {
  WideSearch search;
  for (int k = 0; k < 2 * kRound; ++k) {
    for (const Eigen::Vector2d& place : search.next({10.0, 470.0}, kStep_px, kFrame)) {
      EXPECT_TRUE(place.x() >= 0.0 && place.x() < kFrame.width);
      EXPECT_TRUE(place.y() >= 0.0 && place.y() < kFrame.height);
    }
  }
  for (const Eigen::Vector2d& border : {Eigen::Vector2d(0.0, 240.0), Eigen::Vector2d(320.0, 0.0)}) {
    EXPECT_EQ(WideSearch().next(border, kStep_px, kFrame).front(), border);
  }
  EXPECT_TRUE(WideSearch().next({-1e6, 0.0}, kStep_px, kFrame).empty());
}

}  // namespace
}  // namespace ols::tracker
