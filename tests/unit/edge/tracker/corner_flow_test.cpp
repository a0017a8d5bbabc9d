#include "edge/tracker/corner_flow.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/edge/tracker/synthetic.h"

namespace ols::tracker {
namespace {

struct Pair {
  ImagePyramid before, after;
};

// Two pictures of texture, the second one shifted.
Pair shifted(const cv::Point2d& shift, double noise_sd = 1.0) {
  testing::SyntheticScene scene(testing::Backdrop::kTextured, 3, noise_sd);
  const cv::Point2d camera(400.0, 300.0);
  Pair pair;
  pair.before.build(scene.picture(camera, {}));
  pair.after.build(scene.picture(camera - shift, {}));
  return pair;
}

struct Followed {
  cv::Point2f shift, corner;
  float off_px;
  double least_correlation;
};

// Between the pixels; far, by the smaller images; and far beside the edge: a strip of trees at the
// picture's lower edge is often all there is.
TEST(CornerFlow, FollowsCorners) {
  for (const Followed& one : {Followed{{1.3F, -0.6F}, {100, 100}, 0.1F, 0.9},
                              Followed{{1.3F, -0.6F}, {320, 200}, 0.1F, 0.9},
                              Followed{{14.0F, 9.0F}, {300, 200}, 0.2F, 0.9},
                              Followed{{14.0F, 0.0F}, {300, 474}, 0.2F, 0.7}}) {
    const Pair pair = shifted(one.shift);
    const FollowedCorner found = follow_corner(pair.before, pair.after, one.corner, one.corner);
    EXPECT_NEAR(found.at.x, one.corner.x + one.shift.x, one.off_px) << one.corner;
    EXPECT_NEAR(found.at.y, one.corner.y + one.shift.y, one.off_px) << one.corner;
    EXPECT_GT(found.correlation, one.least_correlation) << one.corner;
  }
}

TEST(CornerFlow, SaysThatNoiseWasNotFollowed) {
  testing::SyntheticScene sky(testing::Backdrop::kSky, 3);
  ImagePyramid before, after;
  before.build(sky.picture({0.0, 0.0}, {}));
  after.build(sky.picture({0.0, 0.0}, {}));
  const cv::Point2f corner(300, 200);
  EXPECT_LT(follow_corner(before, after, corner, corner).correlation, 0.7);
}

TEST(CornerFlow, FindsNothingOffTheImage) {
  const Pair pair = shifted({0.0, 0.0});
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const cv::Point2f inside(300, 200);
  for (const cv::Point2f off :
       {cv::Point2f(-30, 200), cv::Point2f(680, 200), cv::Point2f(300, 510),
        cv::Point2f(-9e9F, 9e30F), cv::Point2f(1e20F, 5), cv::Point2f(kNone, kNone)}) {
    EXPECT_EQ(follow_corner(pair.before, pair.after, off, inside).correlation, -1.0) << off;
    EXPECT_EQ(follow_corner(pair.before, pair.after, inside, off).correlation, -1.0) << off;
  }
}

}  // namespace
}  // namespace ols::tracker
