// The tests of calibration/stationing.h: mistaken landmarks, and deviations that are too small.
#include "calibration/mistaken_landmarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "calibration/stationing.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHighest_rad = radians(10.0);
constexpr double kHeading_rad = radians(211.0);

StationGeometry truth() {
  StationGeometry station;
  station.position = {radians(49.2), radians(16.6), 300.0};
  station.chain.heading_rad = kHeading_rad;
  return station;
}

StationGeometry rough(double level_deg = 0.3) {
  StationGeometry station = truth();
  station.chain.heading_rad = radians(40.0);
  station.sd = {.tilt_rad = radians(level_deg), .mount_rad = radians(0.1)};
  return station;
}

using Sightings = std::vector<LandmarkSighting>;

// All around, with noise of `noisier` times what is stated.
Sightings landmarks(std::size_t count, std::mt19937_64& generator, double noisier = 1.0) {
  std::normal_distribution<double> normal;
  const StationGeometry station = truth();
  Sightings sightings;
  for (std::size_t i = 0; i < count; ++i) {
    const double azimuth_rad = 2.4 * static_cast<double>(i);
    const double distance_m = 400.0 + 150.0 * static_cast<double>(i % 7);
    LandmarkSighting s;
    s.landmark_ecef =
        LocalFrame(station.position)
            .to_ecef({distance_m * std::sin(azimuth_rad), distance_m * std::cos(azimuth_rad),
                      10.0 + 5.0 * static_cast<double>(i % 4)});
    s.landmark_sd_m = 0.05;
    s.pixel_sd_px = 1.0;
    s.pixel = {600.0, 500.0};
    s.angles = aim_at(station, s.landmark_ecef, s.pixel).value();
    const Vector3d off(normal(generator), normal(generator), normal(generator));
    s.landmark_ecef += noisier * s.landmark_sd_m * off;
    s.pixel += noisier * Vector2d(normal(generator), normal(generator));
    sightings.push_back(s);
  }
  return sightings;
}

Sightings landmarks(std::size_t count, double noisier = 1.0) {
  std::mt19937_64 generator(7);
  return landmarks(count, generator, noisier);
}

void shift(LandmarkSighting& s, const Vector3d& by_enu) {
  s.landmark_ecef += LocalFrame(truth().position).R_ecef_enu() * by_enu;
}

std::vector<std::size_t> rejected_landmarks(const Stationing& found) {
  std::vector<std::size_t> sightings;
  for (const LandmarkTest& test : found.landmarks) {
    if (!test.rejected) continue;
    sightings.insert(sightings.end(), test.sightings.begin(), test.sightings.end());
  }
  return sightings;
}

Stationing station(const Sightings& sightings, double level_deg = 0.3) {
  return station_by_landmarks(rough(level_deg), sightings, kHighest_rad);
}

std::optional<LandmarksContradict> contradiction(const Sightings& sightings) {
  try {
    station(sightings);
  } catch (const LandmarksContradict& problem) {
    return problem;
  }
  return std::nullopt;
}

double heading_off_rad(const Stationing& found) {
  return std::abs(
      wrap_pi(found.station.chain.heading_rad + found.station.chain.mount_z_rad - kHeading_rad));
}

TEST(MistakenLandmarks, LandmarksWithoutAMistakeAreAllKept) {
  constexpr int kRuns = 200;
  std::mt19937_64 generator(3);
  int disturbed = 0, rejected = 0;
  for (int i = 0; i < kRuns; ++i) {
    const Stationing found = station(landmarks(5, generator));
    disturbed += rejected_landmarks(found).empty() ? 0 : 1;
    rejected += found.scaled_by > 1.0 ? 1 : 0;
  }
  EXPECT_LE(disturbed, 1);
  // Priors here are kinder than stated: fewer than 5 % of the runs.
  EXPECT_LT(rejected, kRuns / 10);
}

TEST(MistakenLandmarks, AMistakenLandmarkIsNamedAndSetAside) {
  for (const Vector3d& by : {Vector3d(20, -40, 0), Vector3d(0, 0, 3), Vector3d(-700, 900, 0)}) {
    for (std::size_t wrong = 0; wrong < 5; ++wrong) {
      Sightings sightings = landmarks(5);
      shift(sightings[wrong], by);
      const Stationing found = station(sightings);
      EXPECT_THAT(rejected_landmarks(found), testing::ElementsAre(wrong));
      EXPECT_GT(found.landmarks[wrong].w, found.landmarks[wrong].critical);
      EXPECT_LT(heading_off_rad(found), radians(0.02));
      EXPECT_GT(found.residuals[wrong].norm(), 10.0);
    }
  }
}

// The typical mistake: each was taken for the other.
TEST(MistakenLandmarks, TwoExchangedLandmarksAreBothSetAside) {
  Sightings sightings = landmarks(5);
  std::swap(sightings[1].landmark_ecef, sightings[4].landmark_ecef);
  const Stationing found = station(sightings);
  EXPECT_THAT(rejected_landmarks(found), testing::ElementsAre(1, 4));
  EXPECT_LT(heading_off_rad(found), radians(0.02));
}

TEST(MistakenLandmarks, ManyMistakenAmongManyAreSetAside) {
  Sightings sightings = landmarks(40);
  std::vector<std::size_t> wrong;
  for (std::size_t i = 1; i < sightings.size(); i += 4) {
    shift(sightings[i], Vector3d(7.0 + 3.0 * static_cast<double>(i), -20.0, 5.0));
    wrong.push_back(i);
  }
  const Stationing found = station(sightings);
  EXPECT_EQ(rejected_landmarks(found), wrong);
  EXPECT_LT(heading_off_rad(found), radians(0.01));
}

TEST(MistakenLandmarks, FindsFourFifthsOfTheErrorsThatItCallsDetectable) {
  constexpr int kRuns = 200;
  std::mt19937_64 generator(11);
  int seen = 0;
  for (int i = 0; i < kRuns; ++i) {
    Sightings sightings = landmarks(6, generator);
    const double least_m = station(sightings).landmarks[2].detectable_m.y();
    shift(sightings[2], {0.0, 0.0, least_m});
    try {
      const Stationing found = station(sightings);
      seen += found.landmarks[2].w > found.landmarks[2].critical ? 1 : 0;
    } catch (const LandmarksContradict&) {
      ++seen;
    }
  }
  EXPECT_NEAR(1.0 * seen / kRuns, 0.8, 0.1);
}

TEST(MistakenLandmarks, TwoThatContradictAreBothNamed) {
  Sightings sightings = landmarks(2);
  shift(sightings[1], {100, 100, 0});
  const auto problem = contradiction(sightings);
  ASSERT_TRUE(problem);
  ASSERT_EQ(problem->alternatives().size(), 2u);
  EXPECT_THAT(
      (std::vector{problem->alternatives()[0].rejected[0], problem->alternatives()[1].rejected[0]}),
      testing::UnorderedElementsAre(0, 1));
}

TEST(MistakenLandmarks, AMajorityThatIsNoneIsNotBelieved) {
  Sightings sightings = landmarks(4);
  shift(sightings[1], {100, 100, 0});
  shift(sightings[2], {-200, 10, 0});
  EXPECT_TRUE(contradiction(sightings));
  sightings = landmarks(3);
  shift(sightings[1], {100, 100, 0});
  shift(sightings[2], {-200, 10, 0});
  EXPECT_TRUE(contradiction(sightings));
}

// After two of five the tripod was moved: neither heading is a mistake.
TEST(MistakenLandmarks, TwoGroupsThatAgreeAmongThemselvesAreNamed) {
  Sightings sightings = landmarks(5);
  sightings[3].angles.pan_rad += radians(2.0);
  sightings[4].angles.pan_rad += radians(2.0);
  const auto problem = contradiction(sightings);
  ASSERT_TRUE(problem);
  ASSERT_EQ(problem->alternatives().size(), 2u);
  EXPECT_THAT(problem->alternatives()[0].rejected, testing::ElementsAre(3, 4));
  EXPECT_THAT(problem->alternatives()[1].rejected, testing::ElementsAre(0, 1, 2));
}

TEST(MistakenLandmarks, ALandmarkBehindIsNotTakenForOneInFront) {
  Sightings sightings = landmarks(3);
  sightings[2].angles.pan_rad += kPi;
  sightings[2].angles.tilt_rad *= -1.0;
  const Stationing found = station(sightings);
  EXPECT_THAT(rejected_landmarks(found), testing::ElementsAre(2));
  EXPECT_LT(heading_off_rad(found), radians(0.02));
  EXPECT_GT(found.residuals_rad[2].norm(), 3.0);
}

Sightings tilted_by(double tilt_deg) {
  Sightings sightings = landmarks(5);
  StationGeometry tilted = truth();
  tilted.chain.tilt_x_rad = radians(tilt_deg);
  for (LandmarkSighting& s : sightings) s.angles = aim_at(tilted, s.landmark_ecef, s.pixel).value();
  return sightings;
}

TEST(MistakenLandmarks, AWrongLevelIsNotLaidOnTheLandmarks) {
  const Stationing found = station(tilted_by(3.0));
  EXPECT_THAT(rejected_landmarks(found), testing::IsEmpty());
  EXPECT_NEAR(degrees(found.station.chain.tilt_x_rad), 3.0, 0.1);
  EXPECT_GT(found.stated_w[0], 8.0);
  EXPECT_LT(std::abs(found.stated_w[1]), 1.0);
  EXPECT_GT(found.scaled_by, 2.0);
}

TEST(MistakenLandmarks, ALevelThatMakesAllContradictIsNamed) {
  StationGeometry levelled = rough(0.02);
  try {
    station_by_landmarks(levelled, tilted_by(6.0), kHighest_rad);
    FAIL();
  } catch (const LandmarksContradict& problem) {
    EXPECT_THAT(problem.why(), testing::HasSubstr("a tilt of x 6.0"));
  }
}

TEST(MistakenLandmarks, OneThatContradictsTheLevelIsRefused) {
  Sightings sightings = landmarks(1);
  shift(sightings[0], {0, 0, 100});
  const auto problem = contradiction(sightings);
  ASSERT_TRUE(problem);
  EXPECT_THAT(problem->alternatives(), testing::IsEmpty());
  EXPECT_THAT(problem->failing(), testing::ElementsAre(0));
}

TEST(GlobalTest, DeviationsGrowWithTheMisfitAndNeverShrink) {
  const double stated = station(landmarks(12)).station.sd.heading_rad;
  for (const double noisier : {0.1, 3.0, 5.0}) {
    const Stationing found = station(landmarks(12, noisier));
    EXPECT_THAT(rejected_landmarks(found), testing::IsEmpty()) << noisier;
    EXPECT_EQ(found.global.redundancy, 23);
    if (noisier < 1.0) {
      EXPECT_EQ(found.scaled_by, 1.0);
      EXPECT_LT(found.global.variance_factor, 0.5);
    } else {
      EXPECT_NEAR(found.scaled_by, noisier, 0.4 * noisier);
      EXPECT_GT(found.global.variance_factor, found.global.critical);
    }
    EXPECT_NEAR(found.station.sd.heading_rad, found.scaled_by * stated, 0.02 * stated * noisier);
  }
}

TEST(GlobalTest, AMistakeAmongBadSightingsIsStillAMistake) {
  Sightings sightings = landmarks(10, 4.0);
  shift(sightings[6], {60, 60, 0});
  const Stationing found = station(sightings);
  EXPECT_THAT(rejected_landmarks(found), testing::ElementsAre(6));
  EXPECT_GT(found.scaled_by, 2.0);
}

TEST(Layout, OneLandmarkIsCheckedByNothingAcross) {
  const Stationing found = station(landmarks(1));
  EXPECT_TRUE(std::isinf(found.landmarks[0].detectable_m.x()));
  EXPECT_FALSE(std::isinf(found.landmarks[0].detectable_m.y()));  // by the level
}

// What the coordinates are off is in both sightings.
TEST(Layout, SightedAgainALandmarkIsNoBetterKnown) {
  Sightings sightings = landmarks(1);
  sightings[0].landmark_sd_m = 1.0;
  const double once = station(sightings).station.sd.heading_rad;
  sightings.resize(50, sightings[0]);
  const Stationing found = station(sightings);
  EXPECT_GT(found.station.sd.heading_rad, 0.99 * once);
  ASSERT_EQ(found.landmarks.size(), 1u);
  EXPECT_EQ(found.landmarks[0].sightings.size(), 50u);
}

// Three times the same wrong landmark is one mistake.
TEST(Layout, SightedAgainAMistakenLandmarkDoesNotOutvoteTheOthers) {
  Sightings sightings = landmarks(4);
  shift(sightings[0], {30, 50, 0});
  for (int i = 0; i < 5; ++i) sightings.push_back(sightings[0]);
  EXPECT_THAT(rejected_landmarks(station(sightings)), testing::ElementsAre(0, 4, 5, 6, 7, 8));
}

TEST(Layout, InOneDirectionTheTiltAcrossItStaysAsBelieved) {
  Sightings sightings;
  for (const double distance_m : {300.0, 700.0, 1500.0}) {
    LandmarkSighting s;
    s.landmark_ecef = LocalFrame(truth().position).to_ecef({0.0, distance_m, 0.01 * distance_m});
    s.pixel_sd_px = 0.5;
    s.pixel = {600.0, 500.0};
    s.angles = aim_at(truth(), s.landmark_ecef, s.pixel).value();
    sightings.push_back(s);
  }
  StationGeometry levelled = rough();
  levelled.sd.mount_rad = 0.0;
  const Stationing found = station_by_landmarks(levelled, sightings, kHighest_rad);
  EXPECT_NEAR(degrees(found.worst.elevation_sd_rad), 0.3, 0.05);
  EXPECT_NEAR(std::abs(std::sin(found.worst.azimuth_rad)), 1.0, 0.1);
  EXPECT_LT(degrees(found.best.elevation_sd_rad), 0.01);
  EXPECT_NEAR(std::abs(std::cos(found.best.azimuth_rad)), 1.0, 0.1);
  EXPECT_GE(found.station.sd.tilt_rad, 0.99 * found.worst.elevation_sd_rad);
}

}  // namespace
}  // namespace ols::calibration
