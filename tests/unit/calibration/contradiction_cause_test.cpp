#include "calibration/contradiction_cause.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using test::crooked;
using test::just_put_up;
using test::landmarks_around;
using test::night_sky;

bool contradicts(const Problem& problem) {
  try {
    calibrate(Adjustment(network_of(problem)));
    return false;
  } catch (const Contradiction&) {
    return true;
  }
}

// Two of four: neither half is a majority.
TEST(ContradictionCause, NamesTwoLandmarksThatWereExchanged) {
  Problem problem = landmarks_around(crooked(), just_put_up(), 4);
  std::swap(problem.references["landmark1"], problem.references["landmark2"]);
  ASSERT_TRUE(contradicts(problem));
  EXPECT_EQ(causes_of_contradiction(problem),
            std::vector<std::string>{
                "all agree if landmarks 'landmark1' and 'landmark2' were exchanged"});
}

TEST(ContradictionCause, SaysNothingOfTwoThatAreWrongByThemselves) {
  Problem problem = landmarks_around(crooked(), just_put_up(), 4);
  for (const char* name : {"landmark0", "landmark2"}) {
    auto& place = std::get<FixedPoint>(problem.references[name]);
    place.ecef += R_ecef_enu(place.ecef) * Eigen::Vector3d(90.0, name[8] * 3.0 - 150.0, 0.0);
  }
  ASSERT_TRUE(contradicts(problem));
  EXPECT_TRUE(causes_of_contradiction(problem).empty());
}

// Stars that somebody else has named, by a station east of Greenwich that says that it is west.
TEST(ContradictionCause, NamesTheWrongHemisphereOfNamedStars) {
  const auto sky = night_sky(1022, {.frames = 2, .false_detections = 0});
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {sky.station};
  for (std::size_t f = 0; f < sky.frames.size(); ++f) {
    for (std::size_t k = 0; k < sky.frames[f].pixels.size(); ++k) {
      Observation one;
      one.kind = Kind::kStar;
      one.utime_us = sky.frames[f].utime_us;
      one.reading = sky.frames[f].reading;
      one.pixel = sky.frames[f].pixels[k];
      one.sd_px = 0.3;
      one.reference = "HIP " + std::to_string(sky.stars[f][k]);
      problem.references[one.reference] = star_of(*table_star(one.reference));
      problem.observations.push_back(one);
    }
  }
  ASSERT_FALSE(contradicts(problem));
  problem.stations[0].model.geometry.position.longitude_rad *= -1.0;
  ASSERT_TRUE(contradicts(problem));
  EXPECT_EQ(causes_of_contradiction(problem),
            std::vector<std::string>{"all agree if station 'alfa' stands at latitude 49.20, "
                                     "longitude 16.60 deg: is the sign of its position wrong?"});
}

}  // namespace
}  // namespace ols::calibration
