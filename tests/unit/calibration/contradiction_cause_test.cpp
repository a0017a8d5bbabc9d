#include "calibration/contradiction_cause.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using test::crooked;
using test::hill;
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

// A level unit that a workshop has calibrated sights `count` landmarks in two rounds, each at
// another pixel.
Problem two_rounds(int count) {
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {test::prior_of(just_put_up())};
  for (int k = kAspect; k < kInstrumentParameters; ++k)
    problem.stations[0].covariance(k, k) *= 0.01;
  problem.stations[0].covariance(kFocal, kFocal) = 1.0;
  for (int i = 0; i < 2 * count; ++i) {
    const int l = i % count;
    const std::string name = "landmark" + std::to_string(l);
    Observation one = test::landmark(-140.0 + 280.0 * l / (count - 1), l % 3 * 4.0 - 2.0, name);
    one.pixel = {100.0 + 850.0 * (l * 3 % count) / count, 900.0 - 800.0 * (l * 2 % count) / count};
    one.line = static_cast<unsigned>(i + 1);
    problem.references[name] = test::place_seen(hill(), one, 400.0 + 100.0 * l);
    problem.observations.push_back(one);
  }
  return problem;
}

Problem of_five() {
  Problem problem = two_rounds(5);
  EXPECT_FALSE(contradicts(problem));
  return problem;
}

TEST(ContradictionCause, NamesAnAxisThatCountsTheOtherWay) {
  for (const auto& [name, axis] :
       {std::pair{"pan", &UnitReading::pan}, {"tilt", &UnitReading::tilt}}) {
    Problem problem = of_five();
    for (Observation& one : problem.observations) {
      (one.reading.*axis).counts *= -1.0;
      (one.reading.*axis).approach *= -1;
    }
    EXPECT_EQ(causes_of_contradiction(problem),
              std::vector<std::string>{std::string("all agree if ") + name +
                                       " of station 'alfa' counts the other way: is " + name +
                                       "_sign wrong?"});
  }
}

TEST(ContradictionCause, NamesExchangedCoordinates) {
  Problem pixels = of_five();
  for (Observation& one : pixels.observations) std::swap(one.pixel.x(), one.pixel.y());
  EXPECT_EQ(
      causes_of_contradiction(pixels),
      std::vector<std::string>{"all agree if x_px and y_px of station 'alfa' were exchanged"});
  Problem places = of_five();
  const Geodetic position = hill().geometry.position;
  const Eigen::Matrix3d R = R_ecef_enu(position);
  for (auto& [name, reference] : places.references) {
    Eigen::Vector3d& ecef = std::get<FixedPoint>(reference).ecef;
    Eigen::Vector3d enu = R.transpose() * (ecef - ecef_from_geodetic(position));
    std::swap(enu.x(), enu.y());
    ecef = ecef_from_geodetic(position) + R * enu;
  }
  EXPECT_EQ(
      causes_of_contradiction(places),
      std::vector<std::string>{"all agree if east and north of the landmarks were exchanged"});
}

TEST(ContradictionCause, NamesAStationThatIsSurveyedWrongly) {
  Problem problem = of_five();
  Geodetic& position = problem.stations[0].model.geometry.position;
  const Eigen::Vector3d off(-0.4, 0.6, 0.0);
  position = geodetic_from_ecef(ecef_from_geodetic(position) + R_ecef_enu(position) * off);
  const std::vector<std::string> causes = mistakes_of_stations(problem);
  ASSERT_EQ(causes.size(), 1U);
  EXPECT_TRUE(causes[0].starts_with("all agree if station 'alfa' stood 0.4")) << causes[0];
  EXPECT_NE(causes[0].find(" m to the east, 0."), std::string::npos) << causes[0];
  EXPECT_NE(causes[0].find(" m to the south and "), std::string::npos) << causes[0];
  // A receiver that knows its position to a metre may be off by that.
  for (const int k : {kEast, kNorth, kUp}) problem.stations[0].covariance(k, k) = 1.0;
  EXPECT_EQ(mistakes_of_stations(problem), std::vector<std::string>{});
}

// Its counts are off from then on, as when the tripod is turned. What is known of the tilt keeps
// some of it.
TEST(ContradictionCause, NamesAUnitThatLostItsCountsOrATurnedTripod) {
  struct Case {
    const char* name;
    AxisReading UnitReading::*axis;
    double by_deg;
    const char* told;
  };
  for (const Case& one : {Case{"pan", &UnitReading::pan, 0.45, "+0.450 deg of pan"},
                          Case{"tilt", &UnitReading::tilt, 0.05, "-0.048 deg of tilt"}}) {
    Problem problem = two_rounds(5);
    for (std::size_t i = 6; i < problem.observations.size(); ++i) {
      (problem.observations[i].reading.*one.axis).counts += one.by_deg / 360.0 * 112000.0;
    }
    ASSERT_TRUE(contradicts(problem)) << one.name;
    EXPECT_EQ(causes_of_contradiction(problem),
              std::vector<std::string>{"all agree if the tripod of station 'alfa' was turned, or "
                                       "the unit lost its counts, by " +
                                       std::string(one.told) +
                                       " before the sighting of 'landmark1' in line 7"});
  }
}

// Few tries find the place among many: each costs an adjustment of everything.
TEST(ContradictionCause, NamesATurnAmongThousandsOfSightingsOfADrone) {
  constexpr int kSightings = 2000, kTurned = 1280;
  constexpr std::int64_t kNoon_us = 1'780'000'000'000'000, kSecond_us = 1'000'000;
  constexpr double kTurn_deg = 0.45;
  Problem problem = two_rounds(5);
  problem.references["drone"] = Trajectory{.sd_m = 0.02};
  auto& points = std::get<Trajectory>(problem.references["drone"]).points;
  for (Observation& one : problem.observations) one.utime_us = kNoon_us;
  for (int i = 0; i < kSightings; ++i) {
    Observation one = test::landmark(-140.0 + i * 37 % 280, 5.0 + i % 7, "drone");
    one.kind = Kind::kDrone;
    one.line = static_cast<unsigned>(i + 100);
    one.utime_us = kNoon_us + (i + 1) * kSecond_us;
    points.push_back({one.utime_us, test::place_seen(hill(), one, 150.0 + i % 100).ecef});
    if (i >= kTurned) one.reading.pan.counts += kTurn_deg / 360.0 * 112000.0;
    problem.observations.push_back(one);
  }
  points.insert(points.begin(), {kNoon_us, points.front().ecef});
  points.push_back({points.back().utime_us + kSecond_us, points.back().ecef});
  EXPECT_EQ(mistakes_of_stations(problem),
            std::vector<std::string>{"all agree if the tripod of station 'alfa' was turned, or "
                                     "the unit lost its counts, by +0.450 deg of pan before the "
                                     "sighting of 'drone' in line 1380"});
}

// Stars that somebody else has named, by a station east of Greenwich that says that it is west.
TEST(ContradictionCause, NamesTheWrongHemisphereOfNamedStars) {
  Problem problem = test::named_stars(night_sky(1022, {.frames = 2, .false_detections = 0}));
  ASSERT_FALSE(contradicts(problem));
  problem.stations[0].model.geometry.position.longitude_rad *= -1.0;
  ASSERT_TRUE(contradicts(problem));
  EXPECT_EQ(causes_of_contradiction(problem),
            std::vector<std::string>{"all agree if station 'alfa' stands at latitude 49.20, "
                                     "longitude 16.60 deg: is the sign of its position wrong?"});
}

}  // namespace
}  // namespace ols::calibration
