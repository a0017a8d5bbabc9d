#include "calibration/mistaken_sightings.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

using test::crooked;
using test::hill;
using test::just_put_up;
using test::landmarks_around;
using test::rejected;

constexpr std::int64_t kNoon_us = 1'780'000'000'000'000, kSecond_us = 1'000'000;
using Indices = std::set<std::size_t>;

// A drone that hovers at `count` places, sighted at each.
void add_drone(Problem& problem, const StationModel& truth, int count) {
  Trajectory flight;
  flight.sd_m = 0.02;
  for (int i = 0; i < count; ++i) {
    Observation one = test::landmark(-140.0 + 280.0 * i / (count - 1), 5.0 + i % 4 * 6.0, "drone");
    one.kind = Kind::kDrone;
    one.utime_us = kNoon_us + 10 * i * kSecond_us;
    one.reading.pan.approach = i % 2 == 0 ? 1 : -1;
    const Eigen::Vector3d place = test::place_seen(truth, one, 150.0 + 10.0 * i).ecef;
    for (const int s : {-1, 1}) flight.points.push_back({one.utime_us + s * kSecond_us, place});
    problem.observations.push_back(one);
  }
  problem.references["drone"] = flight;
}

Problem drone_alone(int count) {
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {test::prior_of(just_put_up())};
  add_drone(problem, crooked(), count);
  return problem;
}

TEST(MistakenSightings, OfGoodOnesThereAreNone) {
  EXPECT_EQ(mistaken_sightings(network_of(drone_alone(20))), Indices{});
  EXPECT_EQ(mistaken_sightings(network_of(landmarks_around(hill(), hill(), 5))), Indices{});
}

// A bird for one picture: 15 px are four minutes of arc.
TEST(MistakenSightings, OneOfADroneIsNamedAndTheOthersAreGood) {
  for (const double off_px : {10.0, 15.0, 20.0, 300.0}) {
    Problem problem = drone_alone(20);
    problem.observations[7].pixel.x() += off_px;
    const Network whole = network_of(problem);
    ASSERT_EQ(mistaken_sightings(whole), Indices{7}) << off_px;
    const Adjustment adjustment(without(whole, {7}));
    const Calibration found = calibrate(adjustment);
    EXPECT_EQ(rejected(adjustment, found), std::vector<std::string>{}) << off_px;
    EXPECT_FALSE(found.residuals[7]);
    EXPECT_TRUE(found.residuals[8]);
    EXPECT_EQ(adjustment.groups()[0].degrees_of_freedom, 38);
  }
}

TEST(MistakenSightings, TellsEachAdjustment) {
  Problem problem = drone_alone(20);
  int adjustments = 0;
  const auto tell = [&] { ++adjustments; };
  mistaken_sightings(network_of(problem), {}, tell);
  EXPECT_EQ(adjustments, 1) << "nothing is rejected";
  problem.observations[7].pixel.x() += 15.0;
  mistaken_sightings(network_of(problem), {}, tell);
  EXPECT_GE(adjustments, 3) << "another one without what is rejected";
}

// The first one proposes the heading; here it proposes a wrong one.
TEST(MistakenSightings, SomeByManyDegreesDoNotTakeTheHeadingAlong) {
  Problem problem = drone_alone(20);
  for (const std::size_t i : {0U, 1U, 9U, 13U}) {
    problem.observations[i].reading.pan.counts += 1500.0 + 100.0 * static_cast<double>(i);
  }
  EXPECT_EQ(mistaken_sightings(network_of(problem)), (Indices{0, 1, 9, 13}));
}

// Of nine sightings three may be mistaken. Where four are, all are doubted, and none is named.
TEST(MistakenSightings, MoreThanAThirdOfADroneAreLeftToTheTestOfItsGroup) {
  for (const std::size_t wrong : {3U, 4U}) {
    Problem problem = landmarks_around(crooked(), just_put_up(), 3);
    const std::size_t first = problem.observations.size();
    add_drone(problem, crooked(), 9);
    Indices named;
    for (std::size_t i = 0; i < wrong; ++i) {
      const std::size_t one = first + 2 * i;
      problem.observations[one].reading.pan.counts += 1500.0 + 100.0 * static_cast<double>(i);
      if (wrong == 3) named.insert(one);
    }
    EXPECT_EQ(mistaken_sightings(network_of(problem)), named);
  }
}

// Its positions are of a clock that is an hour off, or of another datum: that is not one sighting.
TEST(MistakenSightings, ADroneThatIsWrongAltogetherIsLeftToTheTestOfItsGroup) {
  Problem problem = landmarks_around(crooked(), just_put_up(), 6);
  add_drone(problem, crooked(), 12);
  auto& flight = std::get<Trajectory>(problem.references["drone"]);
  for (auto& point : flight.points) {
    point.ecef += R_ecef_enu(point.ecef) * Eigen::Vector3d(4.0, -3.0, 5.0);
  }
  const Network whole = network_of(problem);
  EXPECT_EQ(mistaken_sightings(whole), Indices{});
  const Adjustment adjustment(whole);
  EXPECT_EQ(rejected(adjustment, calibrate(adjustment)), std::vector<std::string>{"drone"});
}

// Two stations 1.5 km apart, each with its landmarks, and what both follow at the same instants.
Problem joint_track(int count) {
  StationModel there = crooked();
  there.geometry.position.longitude_rad += radians(0.02);
  Problem problem;
  problem.names = {"alfa", "bravo"};
  const StationModel truths[] = {crooked(), there};
  for (std::size_t s = 0; s < 2; ++s) {
    StationModel rough = truths[s];
    rough.geometry.chain = just_put_up().geometry.chain;
    const Problem own = landmarks_around(truths[s], rough, 5);
    problem.stations.push_back(own.stations.front());
    for (Observation one : own.observations) {
      const std::string name = problem.names[s] + one.reference;
      problem.references[name] = own.references.at(one.reference);
      one.reference = name;
      one.station = s;
      problem.observations.push_back(one);
    }
  }
  for (int i = 0; i < count; ++i) {
    Observation one = test::landmark(-100.0 + 20.0 * i, 10.0, "target");
    one.kind = Kind::kTrack;
    one.utime_us = kNoon_us + i * kSecond_us;
    const Eigen::Vector3d place = test::place_seen(truths[0], one, 2500.0).ecef;
    problem.observations.push_back(one);
    one.station = 1;
    Eigen::Vector3d seen = LocalFrame(there.geometry.position).to_enu(place);
    seen.z() += 0.13 * seen.squaredNorm() / (2.0 * 6371e3);
    one.reading = reading_towards(there, {seen, 1.0}, one.pixel, 1, 1).value();
    problem.observations.push_back(one);
  }
  return problem;
}

TEST(MistakenSightings, AnInstantOfATrackGoesWithBothSightings) {
  Problem problem = joint_track(10);
  const std::size_t first = problem.observations.size() - 20;
  EXPECT_EQ(mistaken_sightings(network_of(problem)), Indices{});
  problem.observations[first + 7].pixel.y() += 60.0;
  EXPECT_EQ(mistaken_sightings(network_of(problem)), (Indices{first + 6, first + 7}));
  const Network left = without(network_of(problem), {first + 6, first + 7});
  EXPECT_EQ(left.groups.back().blocks.size(), 9U);
  EXPECT_EQ(rejected(Adjustment(left), calibrate(Adjustment(left))), std::vector<std::string>{});
}

}  // namespace
}  // namespace ols::calibration
