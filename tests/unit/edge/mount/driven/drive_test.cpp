#include "edge/mount/driven/drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kTrip_s = 0.03, kForever_s = 1e9;

// A camera in simulated time: 180 and 90 degrees per unit, 50 deg/s at velocity 1. It keeps the
// time-outs of motions unless it is told not to.
struct Camera {
  double x = 0.0, y = 0.0;
  Vector velocity;
  double until_s = 0.0;  // of the motion
  std::optional<Vector> place;
  bool ignores_timeout = false, ignores_stop = false, ignores_all = false, reversed = false;
  int stops = 0, velocities = 0, places = 0;
  double timeout_s = 1.0;

  void obey(const Order& order, double now_s) {
    stops += order.act == Act::kStop ? 1 : 0;
    velocities += order.act == Act::kVelocity ? 1 : 0;
    places += order.act == Act::kAbsolute ? 1 : 0;
    if (ignores_all || (order.act == Act::kStop && ignores_stop)) return;
    if (order.act == Act::kStop) velocity = {}, place.reset();
    if (order.act == Act::kAbsolute) velocity = {}, place = order.vector;
    if (order.act == Act::kVelocity) {
      velocity = order.vector;
      place.reset();
      until_s = ignores_timeout ? kForever_s : now_s + timeout_s;
    }
  }
  void run(double dt_s, double now_s) {
    if (now_s > until_s) velocity = {};
    if (place) {
      x += std::clamp(place->x - x, -dt_s * 0.1, dt_s * 0.1);
      y += std::clamp(place->y - y, -dt_s * 0.1, dt_s * 0.1);
      return;
    }
    const double sign = reversed ? -1.0 : 1.0;
    x += sign * velocity.x * 50.0 / 180.0 * dt_s;
    y += sign * velocity.y * 50.0 / 90.0 * dt_s;
  }
};

struct DriveTest : ::testing::Test {
  DriveTest() {
    config.pan = {0.0, radians(180.0), radians(50.0)};
    config.tilt = {0.0, radians(90.0), radians(50.0)};
    config.limits = {radians(-170.0), radians(170.0), radians(-80.0), radians(80.0), {}, {}};
    moves.continuous = Space{{-1.0, 1.0}, {-1.0, 1.0}};
  }
  void start() {
    drive.emplace(config);
    drive->connected(moves);
  }
  // `goal_at`: the goal at an instant; nothing: none.
  void run(double seconds, const std::function<std::optional<Goal>(double)>& goal_at = {}) {
    const double end_s = now_s + seconds;
    while (now_s < end_s) {
      drive->set_goal(goal_at ? goal_at(now_s) : std::nullopt);
      const Order order = drive->next(now_s);
      const double trip_s = order.act == Act::kWait ? 0.005 : kTrip_s;
      const double sent_s = now_s;
      track.push_back({now_s, camera.x});
      while (track.size() > 1 && track[1].first <= now_s - late_s) track.pop_front();
      const Vector position{track.front().second, camera.y};
      if (order.act != Act::kStatus) camera.obey(order, now_s);
      camera.run(trip_s, now_s);
      now_s += trip_s;
      if (order.act == Act::kStatus) drive->take(reported.value_or(position), sent_s, now_s);
      look();
      if (order.act != Act::kStatus && order.act != Act::kWait) drive->done(order, now_s);
      for (const AngleSample& sample : drive->take_samples()) newest = sample;
    }
  }
  // Ten pictures a second, if there are pictures.
  void look() {
    if (!scene_deg || now_s - looked_s < 0.1) return;
    pictures.push_back({now_s, pan_deg() + scene_deg(now_s)});
    looked_s = now_s;
    if (pictures.size() < 2 || pictures.back().first - pictures[1].first < pictures_late_s) return;
    const double turn_deg = pictures[1].second - pictures[0].second;
    const double late_s = now_s - pictures[1].first;
    drive->see({pictures[0].first + late_s,
                pictures[1].first + late_s,
                0.0,
                0.0,
                {radians(turn_deg), 0.0},
                {radians(0.01), radians(0.01)}});
    pictures.pop_front();
  }
  Goal rest(double pan_deg, double tilt_deg) const {
    return {now_s, {radians(pan_deg), radians(tilt_deg)}, {}, now_s + 0.5, false, true};
  }
  std::string alarms() const {
    std::string text;
    for (const Alarm& alarm : drive->alarms(now_s)) text += alarm.text + "\n";
    return text;
  }
  double pan_deg() const { return 180.0 * camera.x; }

  DriveConfig config;
  Moves moves;
  std::optional<Drive> drive;
  Camera camera;
  AngleSample newest;
  double now_s = 100.0;
  double late_s = 0.0;                             // the positions that it reports
  std::deque<std::pair<double, double>> track;     // time, x
  std::optional<Vector> reported;                  // the position that it reports wherever it is
  std::function<double(double)> scene_deg;         // motion of the scene in the pictures
  std::deque<std::pair<double, double>> pictures;  // time, pan [deg]
  double looked_s = 0.0, pictures_late_s = 0.0;
};

TEST_F(DriveTest, StopsFirstAndOrdersNoMotionWithoutAGoal) {
  camera.velocity = {1.0, 0.0};  // from a process before
  camera.until_s = kForever_s;
  start();
  EXPECT_EQ(drive->next(now_s).act, Act::kStop);
  run(5.0);
  EXPECT_EQ(camera.velocities + camera.places, 0);
  EXPECT_EQ(camera.velocity.x, 0.0);
  EXPECT_EQ(alarms(), "");
}

TEST_F(DriveTest, ReachesAGoalAtRestAndStands) {
  for (const bool absolute : {false, true}) {
    if (absolute) moves.absolute = Space{{-1.0, 1.0}, {-1.0, 1.0}};
    start();
    run(12.0, [&](double) { return rest(absolute ? 40.0 : -30.0, 20.0); });
    EXPECT_NEAR(pan_deg(), absolute ? 40.0 : -30.0, absolute ? 0.01 : 0.15);
    EXPECT_EQ(camera.places > 0, absolute);
    EXPECT_TRUE(camera.velocity.x == 0.0) << camera.velocity.x;
    EXPECT_EQ(alarms(), "");
  }
}

TEST_F(DriveTest, FollowsFiveDegreesASecond) {
  start();
  const auto goal = [&](double t) {
    return Goal{t, {radians(5.0 * (t - 100.0)), 0.0}, {radians(5.0), 0.0}, t + 0.5};
  };
  run(15.0, goal);
  EXPECT_NEAR(pan_deg(), 5.0 * (now_s - 100.0), 0.3);
  // The reported angle, at its own time.
  EXPECT_NEAR(degrees(newest.angles.pan_rad), 5.0 * (newest.time_s - 100.0), 0.8);
  EXPECT_LT(camera.velocities, 15.0 * 4.0);  // a lease of 1 s is renewed three times in it
  EXPECT_EQ(alarms(), "");
}

TEST_F(DriveTest, NoMotionOutlivesItsLeaseOrItsGoal) {
  start();
  run(3.0, [&](double) { return rest(100.0, 0.0); });
  ASSERT_NE(camera.velocity.x, 0.0);
  const double station_dies_s = now_s;
  while (camera.velocity.x != 0.0) camera.run(0.01, now_s += 0.01);
  EXPECT_LT(now_s - station_dies_s, 1.01);

  camera.ignores_timeout = true;
  run(3.0, [&](double) { return rest(100.0, 0.0); });
  ASSERT_NE(camera.velocity.x, 0.0);
  run(0.2);  // no goal any more
  EXPECT_EQ(camera.velocity.x, 0.0);
}

TEST_F(DriveTest, ALostStopIsRepeatedInAnotherWayAndToldAtLast) {
  camera.ignores_timeout = camera.ignores_stop = true;
  start();
  run(3.0, [&](double) { return rest(100.0, 0.0); });
  run(1.0);
  EXPECT_EQ(camera.velocity.x, 0.0);
  EXPECT_GE(drive->counters().stops_repeated, 1u);
  EXPECT_EQ(alarms(), "");

  run(3.0, [&](double) { return rest(100.0, 0.0); });
  camera.ignores_all = true;
  run(2.5);
  EXPECT_NE(alarms().find("ordered to stop, still moves"), std::string::npos) << alarms();
}

TEST_F(DriveTest, AMotionThatNobodyOrderedIsStoppedAndTold) {
  start();
  run(6.0);
  camera.velocity = {0.3, 0.0};
  camera.until_s = kForever_s;
  const int before = camera.stops;
  run(0.6);
  EXPECT_GT(camera.stops, before);
  EXPECT_EQ(camera.velocity.x, 0.0);
  EXPECT_NE(alarms().find("moves without an order"), std::string::npos);
}

double still(double) { return 0.0; }

TEST_F(DriveTest, AMotionThatOnlyThePicturesShowIsStoppedAndToldAndItsPositionsAreNotBelieved) {
  for (const bool at_goal : {false, true}) {
    camera = {};
    scene_deg = still;
    if (at_goal) moves.absolute = Space{{-1.0, 1.0}, {-1.0, 1.0}};
    const auto goal = [&](double) {
      return at_goal ? std::optional(rest(1.0, 0.0)) : std::nullopt;
    };
    start();
    run(12.0, goal);
    reported = Vector{camera.x, camera.y};
    camera.place.reset();
    camera.velocity = {0.1, 0.0};
    camera.until_s = kForever_s;
    run(0.3, goal);
    EXPECT_EQ(alarms(), "");
    run(0.7, goal);
    EXPECT_NE(alarms().find("the picture moves without an order"), std::string::npos) << alarms();
    EXPECT_EQ(drive->counters().unordered_in_picture, 1u);
    EXPECT_EQ(camera.velocity.x, 0.0);
    run(1.5, goal);
    EXPECT_NE(alarms().find("contradict"), std::string::npos) << alarms();
    if (at_goal) continue;
    camera.velocity = {0.1, 0.0};
    run(1.5);
    const double told_s = newest.time_s;
    run(2.0);
    EXPECT_EQ(newest.time_s, told_s);
    run(35.0);
    EXPECT_GT(newest.time_s, now_s - 1.0) << "a lorry before the camera does not end bearings";
    reported.reset();
  }
}

TEST_F(DriveTest, ACameraThatDoesNotStopIsToldByItsPicturesToo) {
  camera.ignores_timeout = true;
  scene_deg = still;
  start();
  run(3.0, [&](double) { return rest(100.0, 0.0); });
  camera.ignores_all = true;
  reported = Vector{camera.x, camera.y};
  run(6.0);
  EXPECT_NE(alarms().find("ordered to stop, still moves"), std::string::npos) << alarms();
}

TEST_F(DriveTest, WhatIsNoMotionOfTheCameraRaisesNoAlarm) {
  const auto wind = [](double t) { return 0.9 * std::sin(2.0 * kPi * 0.5 * t); };
  const auto clouds = [](double t) { return 1.0 * t; };
  const auto misjudged = [](double t) { return 5.0 * std::floor(t / 3.0); };
  for (const std::function<double(double)>& scene : {+wind, +clouds, +misjudged}) {
    scene_deg = scene;
    start();
    run(30.0);
    EXPECT_EQ(alarms(), "");
  }
}

TEST_F(DriveTest, AnOwnMotionThatThePicturesShowLateRaisesNoAlarm) {
  scene_deg = still;
  pictures_late_s = 1.2;
  start();
  for (const double to_deg : {60.0, -60.0, 0.0}) {
    run(6.0, [&](double) { return rest(to_deg, 0.0); });
    run(6.0);
  }
  EXPECT_EQ(alarms(), "");
}

TEST_F(DriveTest, ACameraThatRebootsIntoItsHomeIsNoticed) {
  start();
  run(15.0, [&](double) { return rest(30.0, 0.0); });
  run(5.0);
  drive->lost();
  camera.x = 0.0;
  drive->connected(moves);
  run(2.0);
  EXPECT_NE(alarms().find("moved while it was not connected"), std::string::npos);
  EXPECT_EQ(drive->counters().moved_unconnected, 1u);
}

TEST_F(DriveTest, ARebootSoonAfterAStopIsNoticed) {
  camera.x = 0.3;
  start();
  run(1.5);
  drive->lost();
  camera.x = 0.0;
  drive->connected(moves);
  run(0.5);
  EXPECT_NE(alarms().find("moved while it was not connected"), std::string::npos);
}

TEST_F(DriveTest, ARebootInMotionDropsTheOrderAndNoAngleIsBelievedBeforeTheCameraRests) {
  start();
  run(6.0, [&](double) { return rest(150.0, 0.0); });
  ASSERT_GT(pan_deg(), 60.0);
  drive->lost();
  EXPECT_FALSE(drive->has_goal());
  camera.velocity = {};
  camera.x = 0.1;
  now_s += 20.0;
  drive->connected(moves);
  camera.place = Vector{0.0, 0.0};  // its home, reached in a second
  camera.ignores_all = true;
  run(0.9);
  EXPECT_NE(alarms().find("moved while it was not connected"), std::string::npos) << alarms();
  EXPECT_LT(newest.time_s, now_s - 20.0);
  run(3.0);
  EXPECT_GT(newest.time_s, now_s - 1.0);
}

TEST_F(DriveTest, ALostConnectionWithoutARebootIsNoMotionOfItsOwn) {
  for (const bool absolute : {false, true}) {
    camera = {};
    if (absolute) moves = {Space{{-1.0, 1.0}, {-1.0, 1.0}}, {}};
    start();
    run(3.0, [&](double) { return rest(100.0, 0.0); });
    drive->lost();
    for (int i = 0; i < 500; ++i) camera.run(0.01, now_s += 0.01);
    drive->connected(moves);
    run(1.0);
    EXPECT_EQ(alarms(), "");
    EXPECT_GT(newest.time_s, now_s - 1.0);
  }
}

TEST_F(DriveTest, ALongTimeOutIsNoMotionOfItsOwn) {
  moves.least_lease_s = camera.timeout_s = 5.0;
  start();
  run(2.0, [&](double) { return rest(160.0, 0.0); });
  drive->lost();
  for (int i = 0; i < 700; ++i) camera.run(0.01, now_s += 0.01);
  drive->connected(moves);
  run(1.0);
  EXPECT_EQ(alarms(), "");
}

TEST_F(DriveTest, AnOrderWhoseAnswerIsLostExplainsAMotion) {
  start();
  run(3.0);
  drive->set_goal(rest(100.0, 0.0));
  for (Order order; order.act != Act::kVelocity; now_s += 0.01) {
    order = drive->next(now_s);
    if (order.act == Act::kStatus) drive->take({camera.x, camera.y}, now_s, now_s);
    camera.obey(order, now_s);
  }
  drive->lost();
  for (int i = 0; i < 500; ++i) camera.run(0.01, now_s += 0.01);
  ASSERT_GT(pan_deg(), 10.0);
  drive->connected(moves);
  run(1.0);
  EXPECT_EQ(alarms(), "");
}

TEST_F(DriveTest, AGoalAtRestIsOrderedOnceHoweverNearItIs) {
  moves.absolute = Space{{-1.0, 1.0}, {-1.0, 1.0}};
  start();
  run(5.0);
  run(8.0, [this](double) { return rest(0.03, 0.0); });
  EXPECT_NEAR(pan_deg(), 0.03, 1e-6) << "a third of a position's sigma away";
  EXPECT_EQ(camera.places, 1) << "what is reported there is its scatter";
  run(5.0, [this](double time_s) { return rest(0.05 + 0.02 * std::sin(7.0 * time_s), 0.0); });
  EXPECT_LE(camera.places, 7) << "a goal that scatters is not followed at each step";
}

TEST_F(DriveTest, AMoveToAPositionThatIsNotCarriedOutIsTold) {
  for (const bool stream : {false, true}) {  // of goals, faster than a move is judged
    camera = {};
    camera.ignores_all = true;
    moves = {Space{{-1.0, 1.0}, {-1.0, 1.0}}, {}};
    start();
    run(4.9,
        [&](double t) { return rest(stream ? 40.0 + std::fmod(std::floor(t), 4.0) : 40.0, 0.0); });
    EXPECT_NE(alarms().find("does not move as ordered"), std::string::npos) << alarms();
    EXPECT_EQ(drive->counters().orders_ignored, 1u);
    const double told_s = newest.time_s;
    run(2.0);
    EXPECT_EQ(newest.time_s, told_s);
    camera.ignores_all = false;
    run(25.0, [&](double) { return rest(40.0, 0.0); });
    EXPECT_GT(newest.time_s, now_s - 1.0);
  }
}

TEST_F(DriveTest, PositionsThatFollowOrdersWhileThePictureStandsAreToldAndEndNothing) {
  for (const bool absolute : {false, true}) {
    camera = {};
    if (absolute) moves = {Space{{-1.0, 1.0}, {-1.0, 1.0}}, {}};
    scene_deg = [&](double) { return -pan_deg(); };
    start();
    run(2.0);
    run(4.6, [&](double) { return rest(150.0, 0.0); });
    EXPECT_NE(alarms().find("contradict the pictures"), std::string::npos) << alarms();
    EXPECT_EQ(drive->counters().orders_ignored, 0u);
    EXPECT_GT(newest.time_s, now_s - 1.0);
    scene_deg = still;
    run(40.0, [&](double) { return rest(-100.0, 0.0); });
    EXPECT_EQ(alarms().find("contradict"), std::string::npos);
  }
}

TEST_F(DriveTest, OrdersThatAreNotCarriedOutEnd) {
  for (const bool reversed : {false, true}) {
    camera = {};
    (reversed ? camera.reversed : camera.ignores_all) = true;
    start();
    run(4.0, [&](double) { return rest(100.0, 0.0); });
    EXPECT_NE(alarms().find("does not move as ordered"), std::string::npos);
    EXPECT_EQ(camera.velocity.x, 0.0);
    EXPECT_LT(std::abs(pan_deg()), 20.0);
    const double told_s = newest.time_s;
    run(2.0);
    EXPECT_EQ(newest.time_s, told_s);  // its positions are not believed
  }
}

TEST_F(DriveTest, ATurnBackWithLatePositionsIsNoDisobedience) {
  start();
  late_s = 0.3;
  run(4.0, [&](double) { return rest(-150.0, 0.0); });
  run(4.0, [&](double) { return rest(150.0, 0.0); });
  EXPECT_EQ(alarms(), "");
}

TEST_F(DriveTest, AnEmergencyStopsAndHoldsUntilItIsCleared) {
  start();
  run(3.0, [&](double) { return rest(100.0, 0.0); });
  drive->emergency_halt();
  EXPECT_EQ(drive->next(now_s).act, Act::kStop);
  const int before = camera.velocities;
  run(2.0, [&](double) { return rest(100.0, 0.0); });
  EXPECT_EQ(camera.velocities, before);
  EXPECT_NE(alarms().find("emergency stop"), std::string::npos);
  drive->clear_emergency();
  run(1.0, [&](double) { return rest(100.0, 0.0); });
  EXPECT_GT(camera.velocities, before);
}

}  // namespace
}  // namespace ols::mount
