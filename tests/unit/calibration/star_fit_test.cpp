#include "calibration/star_fit.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using test::conditions_of;
using test::night_sky;
using test::NightSky;

// From a heading that is wrong by half a degree, with false pairs among the right ones.
TEST(StarFit, EndsOnTheStarsThatAreSeen) {
  const NightSky sky = night_sky(1002);
  const StarVotes votes(sky.station, sky.frames, conditions_of(sky), star_table());
  const StarFit fit(sky.station, votes.frames(), 0.3);
  StarHypothesis hypothesis = votes.hypotheses().front();
  hypothesis.heading_rad += radians(0.5);
  const StarFit::Result found = fit.refined(hypothesis);
  const double heading_rad = sky.truth.geometry.chain.heading_rad;
  EXPECT_NEAR(wrap_pi(found.heading_rad - heading_rad), 0.0, 0.005);
  std::size_t right = 0, seen = 0;
  for (const StarPair& pair : found.pairs) {
    const SeenFrame& frame = votes.frames()[pair.frame];
    const std::int32_t hip = star_table()[frame.sky[pair.star].index].hip;
    right += sky.stars[pair.frame][frame.detections[pair.seen].index] == hip ? 1U : 0U;
  }
  for (const auto& numbers : sky.stars) {
    seen +=
        static_cast<std::size_t>(std::ranges::count_if(numbers, [](int hip) { return hip > 0; }));
  }
  EXPECT_EQ(right, found.pairs.size());
  EXPECT_GE(right + 1, seen);
  EXPECT_LT(found.rms_px, 0.5);
  EXPECT_GE(found.possible, seen);
}

// With nothing to begin with it ends with nothing much.
TEST(StarFit, WithoutPairsFindsNoStars) {
  const NightSky sky = night_sky(1002, {.stars = 0, .false_detections = 10});
  const StarVotes votes(sky.station, sky.frames, conditions_of(sky), star_table());
  const StarFit fit(sky.station, votes.frames(), 0.3);
  EXPECT_LT(fit.refined({}).pairs.size(), 6U);
}

}  // namespace
}  // namespace ols::calibration
