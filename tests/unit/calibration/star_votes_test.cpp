#include "calibration/star_votes.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using test::conditions_of;
using test::night_sky;
using test::NightSky;

// Half a degree of tilt and no heading: the true turn is among the hypotheses, and first.
TEST(StarVotes, TheTrueTurnHasTheMostVotes) {
  const NightSky sky = night_sky(1002);
  const StarVotes votes(sky.station, sky.frames, conditions_of(sky), star_table());
  ASSERT_EQ(votes.frames().size(), 3U);
  const auto hypotheses = votes.hypotheses();
  ASSERT_GE(hypotheses.size(), 2U);
  const double heading_rad = sky.truth.geometry.chain.heading_rad;
  EXPECT_NEAR(wrap_pi(hypotheses[0].heading_rad - heading_rad), 0.0, radians(2.0));
  for (const StarHypothesis& other : hypotheses) {
    if (std::abs(wrap_pi(other.heading_rad - heading_rad)) < radians(2.0)) continue;
    EXPECT_LT(other.votes, hypotheses[0].votes);
  }
  EXPECT_GE(hypotheses[0].pairs.size(), 15U);
}

// A pair turns its detection about the vertical onto its star, but for the lift.
TEST(StarVotes, PairsLieInOneCell) {
  const NightSky sky = night_sky(1000);
  const StarVotes votes(sky.station, sky.frames, conditions_of(sky), star_table());
  const StarHypothesis best = votes.hypotheses().front();
  for (const StarPair& pair : best.pairs) {
    const SeenFrame& frame = votes.frames()[pair.frame];
    const double turn_rad = frame.sky[pair.star].at.azimuth_rad -
                            frame.detections[pair.seen].at.azimuth_rad - best.heading_rad;
    EXPECT_LT(std::abs(wrap_pi(turn_rad)) * std::cos(frame.axis.elevation_rad), radians(5.0));
    EXPECT_LT(std::abs(frame.sky[pair.star].at.elevation_rad -
                       frame.detections[pair.seen].at.elevation_rad),
              radians(2.5));
  }
}

}  // namespace
}  // namespace ols::calibration
