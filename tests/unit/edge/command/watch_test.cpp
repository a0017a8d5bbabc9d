#include "edge/command/watch.h"

#include <gtest/gtest.h>

#include <set>

#include "geometry/angles.h"
#include "tests/unit/edge/station/station_fixture.h"

namespace ols::station {
namespace {

const Eigen::Vector2d kView(radians(6.0), radians(4.0));

WatchConfig field(double width_deg, double height_deg, double elevation_deg = 10.0) {
  return {.middle = AzimuthElevation{radians(350.0), radians(elevation_deg)},
          .size_rad = {radians(width_deg), radians(height_deg)}};
}

double nearest_rad(const std::vector<AzimuthElevation>& pictures, const AzimuthElevation& place) {
  double nearest = kPi;
  for (const AzimuthElevation& picture : pictures) {
    const double across =
        wrap_pi(picture.azimuth_rad - place.azimuth_rad) * std::cos(place.elevation_rad);
    const double up = picture.elevation_rad - place.elevation_rad;
    nearest =
        std::min(nearest, std::max(2 * std::abs(across) / kView.x(), 2 * std::abs(up) / kView.y()));
  }
  return nearest;
}

TEST(PicturesOf, CoverTheWholeFieldWithoutOneTooMany) {
  const struct {
    double width_deg, height_deg, elevation_deg;
    std::size_t pictures;
  } cases[] = {{0, 0, 10, 1}, {6, 4, 0, 1}, {11, 4, 0, 2}, {30, 11, 5, 18}, {20, 4, 60, 2}};
  for (const auto& c : cases) {
    const auto pictures = pictures_of(field(c.width_deg, c.height_deg, c.elevation_deg), kView);
    EXPECT_EQ(pictures.size(), c.pictures) << c.width_deg << " x " << c.height_deg;
    for (double x : {-0.49, -0.2, 0.0, 0.33, 0.49}) {
      for (double y : {-0.49, 0.0, 0.4}) {
        const AzimuthElevation place{radians(350.0 + x * c.width_deg),
                                     radians(c.elevation_deg + y * c.height_deg)};
        EXPECT_LE(nearest_rad(pictures, place), 1.02) << c.width_deg << " at " << x << ", " << y;
      }
    }
  }
}

class WatchTest : public testing::Test {
 protected:
  WatchTest() { config_.geometry.position = {radians(49.2), radians(16.6), 250.0}; }

  // Turns until then with a unit that is at once where it is to be; how often it was sent
  // elsewhere.
  int moves_until(Watch& watch, double end_s, bool sees = false) {
    int moves = 0;
    for (; now_s_ < end_s; now_s_ += 0.1) {
      pointing_.add({.time_s = now_s_, .time_sd_s = 1e-4, .angles = at_});
      const auto goal = watch.step(now_s_, true, sees, pointing_);
      if (!goal) continue;
      EXPECT_TRUE(goal->rests);
      moves += std::hypot(goal->angles.pan_rad - at_.pan_rad,
                          goal->angles.tilt_rad - at_.tilt_rad) > radians(1.0);
      at_ = goal->angles;
    }
    return moves;
  }

  StationConfig config_;
  PointingModel pointing_{config_};
  PanTilt at_;
  double now_s_ = 1.0;
};

TEST_F(WatchTest, WithoutAFieldTheUnitStays) {
  Watch watch{WatchConfig{}};
  EXPECT_EQ(moves_until(watch, 5.0), 0);
  EXPECT_FALSE(watch.step(now_s_, true, false, pointing_));
}

TEST_F(WatchTest, StandsAtAFieldThatThePictureShowsWhole) {
  Watch watch(field(1.0, 1.0));
  EXPECT_EQ(moves_until(watch, 30.0), 1);
  EXPECT_NEAR(degrees(at_.pan_rad), 10.0, 0.2);
  EXPECT_NEAR(degrees(at_.tilt_rad), 10.0, 0.2);
}

TEST_F(WatchTest, StepsThroughALargerFieldAndStaysLongerWhereSomethingIsSeen) {
  Watch watch(field(20.0, 1.0));
  const int quick = moves_until(watch, 31.0);
  EXPECT_GE(quick, 9);
  EXPECT_LE(quick, 11);
  const int slow = moves_until(watch, 61.0, true);
  EXPECT_GE(slow, 2);
  EXPECT_LE(slow, 4) << "never for ever: a mast may be what is seen";
}

TEST_F(WatchTest, LeavesOutWhatTheUnitCannotReach) {
  pointing_.set_limits({-radians(159), radians(12), -radians(46), radians(31)});
  Watch watch(field(20.0, 1.0));
  EXPECT_TRUE(watch.alarm().empty());
  moves_until(watch, 40.0);
  EXPECT_LE(at_.pan_rad, radians(12.0));
  EXPECT_EQ(watch.alarm().parameter("count"), "2") << watch.alarm().text;
  pointing_.set_limits({-radians(159), radians(159), -radians(46), radians(31)});
  moves_until(watch, 42.0);
  EXPECT_TRUE(watch.alarm().empty()) << watch.alarm().text;
}

TEST_F(WatchTest, WaitsWhileTheUnitIsWanted) {
  Watch watch(field(20.0, 1.0));
  moves_until(watch, 3.5);
  EXPECT_FALSE(watch.step(now_s_, false, false, pointing_));
  const PanTilt before = at_;
  const auto goal = watch.step(now_s_ + 100.0, true, false, pointing_);
  ASSERT_TRUE(goal);
  EXPECT_NEAR(goal->angles.pan_rad, before.pan_rad, 1e-9) << "goes on where it was";
}

class WatchingStation : public test::StationTest {
 protected:
  WatchingStation() {
    StationConfig watching = config();
    watching.watch.middle = AzimuthElevation{radians(30.0), radians(5.0)};
    watching_ =
        std::make_unique<Station>(watching, std::make_unique<test::ScriptedTracker>(script_));
    watching_->set_reference(mount::Reference::kTrusted);
  }
  StationOutput turn() {
    now_ += 0.1;
    watching_->on_angles(sample());
    return watching_->step(now_);
  }
  std::unique_ptr<Station> watching_;
};

TEST_F(WatchingStation, WatchesOnlyWhileItIsFree) {
  EXPECT_TRUE(turn().watch);
  watching_->set_reference(mount::Reference::kUnknown);
  EXPECT_FALSE(turn().watch) << "its angles are not known";
  watching_->set_reference(mount::Reference::kTrusted);
  ASSERT_EQ(watching_->slew(slew(60.0), now_), Refusal::kNone);
  EXPECT_FALSE(turn().watch);
  watching_->stop(now_);
  EXPECT_FALSE(turn().watch);
  now_ += 10.0;
  EXPECT_FALSE(turn().watch) << "stopped until it is released";
  ASSERT_EQ(watching_->release(now_), Refusal::kNone);
  EXPECT_TRUE(turn().watch);
  watching_->emergency_stop(true, now_);
  EXPECT_FALSE(turn().watch);
}

// A lost target may come back: the station waits for it, but not for ever.
TEST_F(WatchingStation, ALostTargetKeepsItFromWatchingForAWhile) {
  const auto turn_for = [this](double seconds) {
    StationOutput output;
    for (const double end = now_ + seconds; now_ < end;) {
      output = turn();
      camera::Frame frame;
      frame.mid_exposure_s = now_ - 0.02;
      watching_->on_frame(frame, now_);
    }
    return output;
  };
  turn_for(0.5);
  ASSERT_EQ(watching_->designate({std::nullopt, {629, 469, 20, 20}}, now_), Refusal::kNone);
  EXPECT_FALSE(turn_for(1.0).watch);
  script_.belief = 0.0;
  EXPECT_FALSE(turn_for(10.0).watch);
  EXPECT_EQ(watching_->state(), StationState::kLost);
  EXPECT_TRUE(turn_for(8.0).watch);
}

}  // namespace
}  // namespace ols::station
