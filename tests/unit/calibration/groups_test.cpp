#include "calibration/groups.h"

#include <gtest/gtest.h>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::hill;
using test::landmarks_around;

TEST(Network, RefusesWhatItCannotUseByLine) {
  Problem problem = landmarks_around(hill(), hill(), 3);
  problem.observations[4].reference = "nowhere";
  try {
    network_of(problem);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_EQ(refused.index(), 4U);
    EXPECT_STREQ(refused.what(), "reference: 'nowhere' is not one of the references");
  }
  problem.observations[4].kind = Kind::kStar;
  problem.observations[4].reference = "";
  EXPECT_THROW(network_of(problem), ObservationRefused);
}

TEST(Network, AsksWhetherLatitudeAndLongitudeAreExchanged) {
  Problem problem = landmarks_around(hill(), hill(), 3);
  auto& place = std::get<FixedPoint>(problem.references["landmark1"]);
  Geodetic exchanged = geodetic_from_ecef(place.ecef);
  std::swap(exchanged.latitude_rad, exchanged.longitude_rad);
  place.ecef = ecef_from_geodetic(exchanged);
  try {
    network_of(problem);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_TRUE(std::string(refused.what()).ends_with("are its latitude and longitude exchanged?"))
        << refused.what();
  }
}

TEST(Network, APoseIsOneStop) {
  Problem problem = landmarks_around(hill(), hill(), 3);
  problem.observations[1].pose = problem.observations[4].pose = 7;
  try {
    network_of(problem);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_EQ(refused.index(), 4U);
    EXPECT_EQ(refused.other(), 1U);
    EXPECT_STREQ(refused.what(), "pose: 7 is another stop already, at other counts");
  }
  problem.observations[4].pose.reset();
  problem.observations[0].pose = 7;  // the same stop: both sight landmark0
  EXPECT_EQ(network_of(problem).layout.poses, 1U);
}

// Of landmarks that two stations share, each has its own half.
TEST(Network, AStationAloneHasItsOwnSightings) {
  Problem problem = landmarks_around(hill(), hill(), 3);
  problem.names.emplace_back("bravo");
  problem.stations.push_back(problem.stations.front());
  problem.observations[1].station = problem.observations[5].station = 1;
  const Network network = network_of(problem);
  ASSERT_EQ(network.groups.size(), 3U);
  const Network own = alone(network, 1);
  ASSERT_EQ(own.groups.size(), 2U);
  EXPECT_EQ(own.groups[1].name, "landmark2");
  EXPECT_EQ(own.groups[1].station, 1U);
  EXPECT_EQ(own.groups[1].degrees_of_freedom, 2);
  EXPECT_EQ(own.layout.size(), network.layout.size());
}

// Between its first and its last position a drone may have been anywhere.
TEST(Network, APositionThatNoOtherIsNearIsNotInterpolated) {
  constexpr std::int64_t kNoon_us = 1'780'000'000'000'000;
  Problem problem = landmarks_around(hill(), hill(), 3);
  const Eigen::Vector3d place = std::get<FixedPoint>(problem.references.at("landmark1")).ecef;
  Trajectory flight;
  flight.sd_m = 0.02;
  for (const std::int64_t s : {0, 2, 40, 42}) {
    flight.points.push_back({kNoon_us + 1'000'000 * s, place});
  }
  problem.references["drone"] = flight;
  Observation one = problem.observations[2];
  one.kind = Kind::kDrone;
  one.reference = "drone";
  one.utime_us = kNoon_us + 1'000'000;
  problem.observations.push_back(one);
  EXPECT_EQ(network_of(problem).groups.size(), 4U);
  problem.observations.back().utime_us += 4'000'000;
  try {
    network_of(problem);
    FAIL();
  } catch (const ObservationRefused& refused) {
    EXPECT_EQ(refused.index(), 6U);
    EXPECT_STREQ(
        refused.what(),
        "utime_us: the positions of 'drone' around it are 38 s apart: more than 3 s, it may "
        "have been anywhere");
  }
}

}  // namespace
}  // namespace ols::calibration
