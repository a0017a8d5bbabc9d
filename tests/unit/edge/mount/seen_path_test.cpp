#include "edge/mount/seen_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ols::mount {
namespace {

using Added = SeenPath::Added;

SeenTurn turn(double from_s, double to_s, double pan_rad, double sd_rad = 0.001) {
  SeenTurn turn;
  turn.from_s = from_s;
  turn.to_s = to_s;
  turn.turn.pan_rad = pan_rad;
  turn.sd = {sd_rad, sd_rad};
  return turn;
}

TEST(SeenPath, AddsTurnsAndTheirVariances) {
  SeenPath path(5.0);
  EXPECT_FALSE(path.at(1.0));
  EXPECT_EQ(path.add(turn(1.0, 1.1, 0.02)), Added::kBegun);
  EXPECT_EQ(path.add(turn(1.1, 1.2, 0.02)), Added::kContinued);
  for (const double time_s : {1.0, 1.07, 1.2}) {
    const auto at = path.at(time_s);
    ASSERT_TRUE(at) << time_s;
    EXPECT_NEAR(at->turned.pan_rad, 0.2 * (time_s - 1.0), 1e-12);
    EXPECT_NEAR(at->rate.pan_rad, 0.2, 1e-9);
    EXPECT_NEAR(at->walk.pan_rad, 1e-5 * (time_s - 1.0), 1e-15);
    EXPECT_NEAR(at->bend.pan_rad, 0.0, 1e-15);
  }
  EXPECT_FALSE(path.at(0.99));
}

TEST(SeenPath, GoesOnForOnePictureAtMost) {
  SeenPath path(5.0);
  path.add(turn(1.0, 1.1, 0.02));
  EXPECT_TRUE(path.covers(1.1));
  EXPECT_FALSE(path.covers(1.11));
  EXPECT_NEAR(path.at(1.19)->turned.pan_rad, 0.038, 1e-12);
  EXPECT_FALSE(path.at(1.21));
}

// Two that see the same: a slow one, with every third picture, and a quick one that ends.
TEST(SeenPath, ContinuesFromAnyOfItsPictures) {
  SeenPath path(5.0);
  for (int i = 0; i < 4; ++i) path.add(turn(1.0 + 0.1 * i, 1.1 + 0.1 * i, 0.02));
  EXPECT_EQ(path.add(turn(1.0, 1.3, 0.5)), Added::kIgnored) << "it is known already";
  EXPECT_EQ(path.add(turn(1.3, 1.6, 0.06)), Added::kContinued);
  EXPECT_NEAR(path.at(1.6)->turned.pan_rad, 0.12, 1e-12);
}

TEST(SeenPath, BeginsAnewAfterAPictureWithoutMotion) {
  SeenPath path(5.0);
  path.add(turn(1.0, 1.1, 0.02));
  EXPECT_EQ(path.add(turn(1.2, 1.3, 0.02)), Added::kBegun);
  EXPECT_FALSE(path.at(1.15));
  EXPECT_NEAR(path.at(1.3)->turned.pan_rad, 0.02, 1e-12);
}

TEST(SeenPath, IsOfTheRowsThatShowIt) {
  SeenPath path(5.0);
  SeenTurn rows = turn(1.0, 1.1, 0.02);
  rows.row_s = 0.01;
  path.add(rows);
  EXPECT_FALSE(path.at(1.005));
  EXPECT_NEAR(path.at(1.11)->turned.pan_rad, 0.02, 1e-12);
}

TEST(SeenPath, StatesHowMuchAChangingRateMayBendIt) {
  SeenPath path(5.0);
  path.add(turn(1.0, 1.1, 0.00));
  path.add(turn(1.1, 1.2, 0.02));  // 2 rad/s^2
  EXPECT_EQ(path.at(1.1)->bend.pan_rad, 0.0);
  EXPECT_NEAR(std::sqrt(path.at(1.15)->bend.pan_rad), 0.5 * 2.0 * 0.05 * 0.05, 1e-12);
}

TEST(SeenPath, IgnoresWhatIsNotFinite) {
  SeenPath path(5.0);
  EXPECT_EQ(path.add(turn(1.0, 1.1, std::nan(""))), Added::kIgnored);
  EXPECT_EQ(path.add(turn(1.0, std::nan(""), 0.1)), Added::kIgnored);
  EXPECT_EQ(path.add(turn(1.0, 1.0, 0.1)), Added::kIgnored);
}

TEST(SeenPath, ForgetsWhatIsOlderThanItsSpan) {
  SeenPath path(1.0);
  for (int i = 0; i < 20; ++i) path.add(turn(0.1 * i, 0.1 * (i + 1), 0.02));
  EXPECT_FALSE(path.at(0.9));
  EXPECT_TRUE(path.at(1.05));
}

}  // namespace
}  // namespace ols::mount
