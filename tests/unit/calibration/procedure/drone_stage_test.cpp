#include "calibration/procedure/drone_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"
#include "tests/unit/calibration/procedure/stopped.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

constexpr std::int64_t kStart_us = 1'780'000'000'000'000;

// A drone that hovers where it is let, and says so once a second.
class DroneStageTest : public testing::Test {
 protected:
  DroneStageTest() {
    truth = test::hill();
    believed = truth;
    believed.geometry.chain.heading_rad += radians(1.0);
    flight.sd_m = 0.02;
  }
  DroneStage stage(int points, Adviser adviser = nullptr) {
    return {believed,
            {"drone", points},
            [this] { return flight; },
            [this] { return now_us; },
            [](const PanTilt& at) { return std::abs(at.pan_rad) < 2.7 && at.tilt_rad < 0.54; },
            std::move(adviser)};
  }
  void hover(double azimuth_deg, double elevation_deg) {
    const LocalFrame ground(truth.geometry.position);
    const Eigen::Vector3d ecef = ground.to_ecef(
        250.0 * enu_from_azimuth_elevation({radians(azimuth_deg), radians(elevation_deg)}));
    for (int i = 0; i < 5; ++i) flight.points.push_back({now_us += 1'000'000, ecef});
  }
  Taken shoot(const Shot& shot) {
    now_us += 700'000;
    Taken taken = test::stopped(shot, ++pose, now_us);
    taken.gray = cv::Mat(960, 1280, CV_8U, cv::Scalar(170));
    const auto at =
        view(truth.geometry, corrected_angles(truth, taken.reading), flight.points.back().ecef);
    if (at) {
      constexpr int kShift = 4;
      const auto fixed = [](double v) { return static_cast<int>(std::lround(v * 16.0)); };
      cv::circle(taken.gray, {fixed(at->pixel.x()), fixed(at->pixel.y())}, fixed(5.0),
                 cv::Scalar(30), cv::FILLED, cv::LINE_AA, kShift);
      seen = at->pixel;
    }
    flight.points.push_back({now_us += 300'000, flight.points.back().ecef});
    return taken;
  }
  // Sights the drone where it hovers; the person points where he is asked. How many questions.
  int sight(DroneStage& of) {
    int questions = 0;
    const std::size_t before = of.observations().size();
    of.answered({"sight", {}, {}, now_us});
    while (questions < 8) {
      const auto order = of.next();
      if (of.observations().size() > before) break;
      if (order->kind == Order::Kind::kShoot) {
        of.taken(shoot(order->shot));
        continue;
      }
      ++questions;
      const bool right =
          order->question.crosshair_px && (*order->question.crosshair_px - seen).norm() < 1.0;
      const bool visible = cv::Rect2d(0, 0, 1280, 960).contains({seen.x(), seen.y()});
      EXPECT_TRUE(visible);
      of.answered(right ? Answer{"confirm", {}, {}}
                        : Answer{"point", seen + Eigen::Vector2d(2.0, -2.0), {}});
    }
    return questions;
  }

  StationModel truth, believed;
  Trajectory flight;
  std::int64_t now_us = kStart_us, pose = 0;
  Eigen::Vector2d seen = Eigen::Vector2d::Zero();
};

TEST_F(DroneStageTest, ThePersonPointsOnceAndTheUnitFindsItFromThenOn) {
  DroneStage drone = stage(4);
  hover(40.0, 5.0);
  EXPECT_EQ(sight(drone), 2);  // points, confirms
  for (const auto& [azimuth, elevation] : {std::pair{90.0, 15.0}, {-20.0, 25.0}, {150.0, 3.0}}) {
    hover(azimuth, elevation);
    EXPECT_EQ(sight(drone), 0) << azimuth;
  }
  EXPECT_FALSE(drone.next());
  EXPECT_EQ(drone.progress(), 1.0);
  const auto all = drone.observations();
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[1].kind, Kind::kDrone);
  EXPECT_EQ(all[1].reference, "drone");
  EXPECT_EQ(all[1].reading.pan.approach, -1);
  // What an adjustment needs: each instant within what is known of the flight.
  for (const Observation& one : all) {
    EXPECT_TRUE(position_at(flight, one.utime_us, 0));
    const auto at = view(truth.geometry, corrected_angles(truth, one.reading),
                         *position_at(flight, one.utime_us, 0));
    EXPECT_LT((at->pixel - one.pixel).norm(), 0.2);
  }
}

TEST_F(DroneStageTest, APositionThatIsOldOrMissingIsSaidAndNothingMoves) {
  DroneStage drone = stage(4);
  drone.answered({"sight", {}, {}, now_us});
  EXPECT_NE(drone.next()->question.text.find("No position"), std::string::npos);
  hover(40.0, 5.0);
  now_us += 12'000'000;
  drone.answered({"sight", {}, {}, now_us});
  ASSERT_EQ(drone.next()->kind, Order::Kind::kAsk);
  EXPECT_NE(drone.next()->question.text.find("12 s old"), std::string::npos);
  hover(40.0, 60.0);
  drone.answered({"sight", {}, {}, now_us});
  EXPECT_NE(drone.next()->question.text.find("cannot look there"), std::string::npos);
  drone.answered({"done", {}, {}});
  EXPECT_FALSE(drone.next());
  EXPECT_NE(drone.take_remarks().at(0).find("not sighted"), std::string::npos);
}

TEST_F(DroneStageTest, WhereTheDroneIsNotThePersonIsAsked) {
  DroneStage drone = stage(4);
  hover(40.0, 5.0);
  sight(drone);
  hover(90.0, 15.0);
  drone.answered({"sight", {}, {}, now_us});
  Taken empty = shoot(drone.next()->shot);
  empty.gray.setTo(170);
  drone.taken(empty);
  const auto order = drone.next();
  ASSERT_EQ(order->kind, Order::Kind::kAsk);
  EXPECT_NE(order->question.text.find("Point at drone"), std::string::npos);
  drone.answered({"skip", {}, {}});
  EXPECT_EQ(drone.observations().size(), 1U);
  EXPECT_NE(drone.next()->question.text.find("Skipped"), std::string::npos);
}

TEST_F(DroneStageTest, APictureWaitsForPositionsThatReachBeyondIt) {
  DroneStage drone = stage(1);
  hover(40.0, 5.0);
  drone.answered({"sight", {}, {}, now_us});
  const Taken picture = shoot(drone.next()->shot);
  const Trajectory::Point later = flight.points.back();
  ASSERT_GT(later.utime_us, picture.utime_us);
  flight.points.pop_back();
  drone.taken(picture);
  EXPECT_EQ(drone.next()->kind, Order::Kind::kWait);
  EXPECT_EQ(drone.next()->kind, Order::Kind::kWait);
  flight.points.push_back(later);
  EXPECT_EQ(drone.next()->kind, Order::Kind::kAsk);
  EXPECT_NE(drone.next()->question.text.find("Point at drone"), std::string::npos);
}

TEST_F(DroneStageTest, APictureThatNoPositionReachesIsNone) {
  DroneStage drone = stage(1);
  hover(40.0, 5.0);
  drone.answered({"sight", {}, {}, now_us});
  const Taken picture = shoot(drone.next()->shot);
  flight.points.pop_back();
  drone.taken(picture);
  EXPECT_EQ(drone.next()->kind, Order::Kind::kWait);
  now_us += 4'000'000;
  ASSERT_EQ(drone.next()->kind, Order::Kind::kAsk);
  EXPECT_NE(drone.next()->question.text.find("positions have ended before"), std::string::npos);
  EXPECT_TRUE(drone.observations().empty());
}

TEST_F(DroneStageTest, ItSaysWhereTheDroneHelpsMost) {
  std::vector<Place> offered;
  DroneStage drone = stage(4, [&offered](const StationModel&, const std::vector<Place>& places) {
    offered = places;
    return std::vector<Foretold>{{places[0].name, 5e-5}};
  });
  hover(40.0, 5.0);
  sight(drone);
  ASSERT_GE(offered.size(), 15U);
  EXPECT_EQ(offered[0].sd_m, 0.02);
  EXPECT_NE(drone.next()->question.text.find("Most helps: " + offered[0].name + " would leave"),
            std::string::npos);
}

TEST(PositionAt, IsBetweenTheKnownOnesAndALittleAfter) {
  Trajectory flight;
  EXPECT_FALSE(position_at(flight, 5, 10));
  flight.points = {{100, {0.0, 0.0, 0.0}}, {200, {10.0, 0.0, 0.0}}};
  EXPECT_FALSE(position_at(flight, 99, 10));
  EXPECT_NEAR(position_at(flight, 150, 10)->x(), 5.0, 1e-12);
  EXPECT_NEAR(position_at(flight, 210, 10)->x(), 10.0, 1e-12);
  EXPECT_FALSE(position_at(flight, 211, 10));
  flight.points.push_back({3'500'200, {10.0, 0.0, 0.0}});
  EXPECT_FALSE(position_at(flight, 1000, 10));  // nothing for more than three seconds
}

}  // namespace
}  // namespace ols::calibration
