#include "calibration/procedure/sun_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibration/calibrate.h"
#include "geometry/angles.h"
#include "tests/unit/calibration/procedure/stopped.h"
#include "tests/unit/calibration/scene.h"

namespace ols::calibration {
namespace {

constexpr std::int64_t kMorning_us = 1'773'991'800'000'000;  // 2026-03-20 07:30 UTC

// A tripod in the morning, whose camera sees the sun's disc, through a filter or not.
class SunStageTest : public testing::Test {
 protected:
  SunStageTest() {
    truth = test::hill();
    truth.geometry.chain.heading_rad = radians(130.0);
    believed = truth;
    believed.geometry.chain.heading_rad += radians(0.4);
    keep_out = std::make_shared<SunKeepOut>(believed, [this] { return now_us; });
  }
  SunStage stage() {
    return {believed, keep_out, [this](const PanTilt& at) {
              return std::abs(at.pan_rad) < 2.7 && at.tilt_rad < highest_rad;
            }};
  }
  Taken shoot(const Shot& shot) {
    now_us += 5'000'000;
    Taken taken = test::stopped(shot, ++pose, now_us);
    taken.gray = cv::Mat(960, 1280, CV_8U, cv::Scalar(filter ? 2 : 250));
    const Geodetic& place = truth.geometry.position;
    const SkyDirection sun = sun_direction(taken.utime_us, place, standard_air(place.height_m), {});
    const auto image = predict_pixel(truth, taken.reading,
                                     {LocalFrame(place).R_ecef_enu().transpose() * sun.ecef, 0.0});
    if (filter && image) draw(taken.gray, image->pixel);
    return taken;
  }
  void draw(cv::Mat& gray, const Eigen::Vector2d& at) const {
    const double radius_px = truth.geometry.camera.fx_px * 959.63 / 206264.8;
    for (int y = 0; y < gray.rows; ++y) {
      for (int x = 0; x < gray.cols; ++x) {
        const double r = std::hypot(x - at.x(), y - at.y());
        const double value = 2.0 + 180.0 / (1.0 + std::exp((r - radius_px) / 0.5));
        gray.at<unsigned char>(y, x) = static_cast<unsigned char>(std::lround(value));
      }
    }
  }
  // Carries everything out; the person confirms what he is asked for. How many pictures.
  int run(SunStage& of) {
    int pictures = 0;
    for (int orders = 0; orders < 60; ++orders) {
      const auto order = of.next();
      if (!order) return pictures;
      if (order->kind == Order::Kind::kAsk) {
        asked.push_back(order->question.text);
        of.answered({order->question.choices.front(), {}, {}});
        continue;
      }
      ++pictures;
      hindered += keep_out->hindrance(order->shot.angles).empty() ? 0 : 1;
      of.taken(shoot(order->shot));
    }
    ADD_FAILURE() << "it does not end";
    return pictures;
  }

  StationModel truth, believed;
  std::int64_t now_us = kMorning_us, pose = 0;
  double highest_rad = radians(31.0);
  bool filter = true;
  int hindered = 0;
  std::shared_ptr<SunKeepOut> keep_out;
  std::vector<std::string> asked;
};

TEST_F(SunStageTest, TheFilterIsProvedFirstAndTakenOffAtTheEnd) {
  SunStage sun = stage();
  EXPECT_EQ(run(sun), 1 + 8 + 1);
  EXPECT_EQ(hindered, 0) << "no order looks where the unit must not";
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_NE(asked[0].find("Put the sun filter on"), std::string::npos);
  EXPECT_NE(asked[1].find("Take the sun filter off"), std::string::npos);
  const auto all = sun.observations();
  ASSERT_EQ(all.size(), 8U);
  EXPECT_EQ(all[0].kind, Kind::kSun);
  EXPECT_EQ(std::ranges::count_if(
                all, [](const Observation& one) { return one.reading.pan.approach == -1; }),
            4);
  EXPECT_TRUE(sun.take_remarks().empty());
  // The keep-out is in force again.
  const auto at_sun = aim_along(believed.geometry, azimuth_elevation_from_enu(keep_out->sun_enu()));
  EXPECT_FALSE(keep_out->hindrance(*at_sun).empty());
}

TEST_F(SunStageTest, APictureThatIsNotBlackProvesThatNoFilterIsOn) {
  SunStage sun = stage();
  filter = false;
  sun.answered({"filter_on", {}, {}});
  const auto beside = sun.next();
  ASSERT_TRUE(beside);
  EXPECT_TRUE(keep_out->hindrance(beside->shot.angles).empty());
  sun.taken(shoot(beside->shot));
  const auto order = sun.next();
  ASSERT_EQ(order->kind, Order::Kind::kAsk);
  EXPECT_NE(order->question.text.find("is not black: no filter is on"), std::string::npos);
  const auto at_sun = aim_along(believed.geometry, azimuth_elevation_from_enu(keep_out->sun_enu()));
  EXPECT_FALSE(keep_out->hindrance(*at_sun).empty());
  filter = true;
  EXPECT_EQ(run(sun), 10);
  EXPECT_EQ(sun.observations().size(), 8U);
}

TEST_F(SunStageTest, AfterAnInterruptionTheFilterIsProvedAgain) {
  SunStage sun = stage();
  sun.answered({"filter_on", {}, {}});
  for (int i = 0; i < 3; ++i) sun.taken(shoot(sun.next()->shot));
  ASSERT_EQ(sun.observations().size(), 2U);
  sun.resumed();
  const auto at_sun = aim_along(believed.geometry, azimuth_elevation_from_enu(keep_out->sun_enu()));
  EXPECT_FALSE(keep_out->hindrance(*at_sun).empty());
  EXPECT_EQ(run(sun), 1 + 6 + 1);
  EXPECT_EQ(sun.observations().size(), 8U);
}

// What was sighted stands, each with its time; the others are aimed at where the sun is by now.
TEST_F(SunStageTest, AfterHoursItGoesOnWithTheSunOfThatTime) {
  highest_rad = radians(60.0);
  SunStage sun = stage();
  sun.answered({"filter_on", {}, {}});
  for (int i = 0; i < 3; ++i) sun.taken(shoot(sun.next()->shot));
  now_us += 3LL * 3600 * 1'000'000;
  sun.resumed();
  EXPECT_EQ(run(sun), 1 + 6 + 1);
  const auto all = sun.observations();
  ASSERT_EQ(all.size(), 8U);
  EXPECT_GT(std::abs(all[2].reading.pan.counts - all[1].reading.pan.counts), 5000.0);
  EXPECT_GT(all[2].utime_us, all[1].utime_us + 3LL * 3600 * 1'000'000);
}

TEST_F(SunStageTest, AfterSunsetItKeepsWhatItHasAndTheFilterComesOff) {
  SunStage sun = stage();
  sun.answered({"filter_on", {}, {}});
  for (int i = 0; i < 3; ++i) sun.taken(shoot(sun.next()->shot));
  now_us += 12LL * 3600 * 1'000'000;
  sun.resumed();
  EXPECT_EQ(run(sun), 0);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_NE(asked[0].find("Take the sun filter off"), std::string::npos) << asked[0];
  EXPECT_EQ(sun.observations().size(), 2U);
  EXPECT_NE(sun.take_remarks().at(0).find("sun: no more pictures than 2: it stands"),
            std::string::npos);
}

// Interrupted while it looks at the sun, it still looks there when a person gives up.
TEST_F(SunStageTest, WhileTheSunIsUpTheUnitTurnsAwayBeforeTheFilterComesOff) {
  for (const bool turns : {true, false}) {
    SunStage of = stage();
    of.answered({"filter_on", {}, {}});
    of.taken(shoot(of.next()->shot));  // beside it
    of.taken(shoot(of.next()->shot));  // at it
    of.resumed();
    of.answered({"skip", {}, {}});
    const auto away = of.next();
    ASSERT_TRUE(away);
    ASSERT_EQ(away->kind, Order::Kind::kShoot);
    EXPECT_EQ(keep_out->hindrance(away->shot.angles), "");
    if (turns) {
      of.taken(shoot(away->shot));
    } else {
      of.not_taken("the unit does not answer");
    }
    const std::string text = of.next()->question.text;
    EXPECT_EQ(text.find("cover the lens") == std::string::npos, turns) << text;
    of.answered({"filter_off", {}, {}});
    EXPECT_FALSE(of.next());
  }
}

TEST_F(SunStageTest, ASunThatIsNotInThePictureIsTurnedTo) {
  believed.geometry.chain.heading_rad += radians(5.0);
  keep_out = std::make_shared<SunKeepOut>(believed, [this] { return now_us; });
  SunStage sun = stage();
  sun.answered({"filter_on", {}, {}});
  sun.taken(shoot(sun.next()->shot));
  sun.taken(shoot(sun.next()->shot));
  const auto order = sun.next();
  ASSERT_EQ(order->kind, Order::Kind::kAsk);
  EXPECT_NE(order->question.text.find("no disc stands out"), std::string::npos);
  sun.answered({"turn", {}, {-radians(5.4), 0.0}});
  sun.taken(shoot(sun.next()->shot));
  EXPECT_EQ(sun.observations().size(), 1U);
}

TEST_F(SunStageTest, ASunThatIsTooLowOrTooHighIsLeftOut) {
  now_us -= 5LL * 1800 * 1'000'000;  // 05:00 UTC: it has just risen
  SunStage low = stage();
  EXPECT_FALSE(low.next());
  EXPECT_NE(low.take_remarks().at(0).find("below 10 the refraction"), std::string::npos);
  now_us = kMorning_us;
  highest_rad = radians(12.0);
  SunStage high = stage();
  EXPECT_FALSE(high.next());
  EXPECT_NE(high.take_remarks().at(0).find("the unit cannot look there"), std::string::npos);
}

// What its sightings give to an adjustment: a heading, where the compass was off by 0.4 degrees.
TEST_F(SunStageTest, TheSunTellsTheHeading) {
  SunStage sun = stage();
  run(sun);
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {test::prior_of(believed)};
  for (const int k : {kTiltX, kTiltY}) {
    problem.stations[0].covariance(k, k) = std::pow(10.0 * test::kArcsec, 2);
  }
  problem.ut1_sd_s = 1e-3;
  problem.observations = sun.observations();
  const Calibration found = calibrate(Adjustment(network_of(problem)));
  const StationModel& model = found.fit.state.stations[0].model;
  const UnitReading& reading = problem.observations[0].reading;
  const Eigen::Vector2d middle(639.5, 479.5);
  const auto seen = predict_direction(model, reading, middle);
  const auto there = predict_direction(truth, reading, middle);
  EXPECT_LT(std::abs(wrap_pi(seen->direction.azimuth_rad - there->direction.azimuth_rad)),
            10.0 * test::kArcsec);
}

}  // namespace
}  // namespace ols::calibration
