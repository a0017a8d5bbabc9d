#include "edge/command/slew_search.h"

#include <gtest/gtest.h>

#include <memory>

#include "geometry/angles.h"
#include "tests/unit/edge/station/station_fixture.h"

namespace ols::station {
namespace {

// The PTU stands at zero: the optical axis is on azimuth 0, elevation 0.
class SlewSearchTest : public testing::Test {
 protected:
  SlewSearchTest() { config_.geometry.position = {radians(49.2), radians(16.6), 250.0}; }

  camera::Frame frame(double time_s) {
    for (; angles_s_ <= time_s; angles_s_ += 0.1) {
      pointing_.add({.time_s = angles_s_, .time_sd_s = 1e-4, .angles = {}});
    }
    camera::Frame frame;
    frame.mid_exposure_s = time_s;
    return frame;
  }
  static SlewSearch::Slew slew(double azimuth_deg = 0.0, double sd_rad = 1e-4) {
    SlewCommand command;
    command.direction = {radians(azimuth_deg), 0.0};
    command.direction_sd_rad = sd_rad;
    return command;
  }
  // Where a slew leads for that long.
  void in_view(double from_s, double to_s) {
    for (double time_s = from_s; time_s <= to_s + 1e-9; time_s += 0.5) {
      search_.note_in_view(frame(time_s), pointing_, slew());
    }
  }

  StationConfig config_;
  PointingModel pointing_{config_};
  SlewSearch search_{config_};
  double angles_s_ = 0.0;
};

TEST_F(SlewSearchTest, SendsTheTrackerToTheSlewsPixelFromTimeToTime) {
  search_.restart(false);
  const auto place = search_.send_tracker(frame(1.0), pointing_, slew());
  ASSERT_TRUE(place);
  const CameraIntrinsics& camera = config_.geometry.camera;
  EXPECT_NEAR(place->pixel.x(), camera.cx_px, 1.0);
  EXPECT_NEAR(place->pixel.y(), camera.cy_px, 1.0);
  EXPECT_FALSE(search_.send_tracker(frame(1.4), pointing_, slew())) << "sent a moment ago";
  EXPECT_TRUE(search_.send_tracker(frame(1.6), pointing_, slew()));
  search_.restart(false);
  EXPECT_TRUE(search_.send_tracker(frame(1.7), pointing_, slew())) << "a new search begins";
}

TEST_F(SlewSearchTest, SendsItNowhereBeforeThePtuHasArrived) {
  search_.restart(false);
  EXPECT_FALSE(search_.send_tracker(frame(1.0), pointing_, slew(60.0))) << "not in the picture";
  EXPECT_FALSE(search_.send_tracker(frame(1.1), pointing_, std::nullopt));
  pointing_.forget_angles();
  EXPECT_FALSE(search_.send_tracker(frame(1.15), pointing_, slew())) << "no angles";
  EXPECT_TRUE(search_.send_tracker(frame(1.3), pointing_, slew())) << "none of it counts as sent";
}

TEST_F(SlewSearchTest, SearchesAsWidelyAsTheDirectionIsUncertain) {
  const auto sd_px = [this](double sd_rad) {
    search_.restart(false);
    return search_.send_tracker(frame(angles_s_ + 1.0), pointing_, slew(0.0, sd_rad)).value().sd_px;
  };
  EXPECT_EQ(sd_px(0.0), config_.search_sd_px) << "never narrower";
  EXPECT_EQ(sd_px(1.0), max_search_sd_px(config_)) << "never wider";
  const double between_px = 0.5 * (config_.search_sd_px + max_search_sd_px(config_));
  EXPECT_NEAR(sd_px(between_px / config_.geometry.camera.fx_px), between_px, 1e-9);
}

TEST_F(SlewSearchTest, AnObjectElsewhereIsNotTheSlewsTarget) {
  const camera::Frame now = frame(1.0);
  tracker::TrackerOutput output;
  const CameraIntrinsics& camera = config_.geometry.camera;
  output.pixel = {camera.cx_px + 3.5 * config_.search_sd_px, camera.cy_px};
  EXPECT_TRUE(search_.is_where_slewed(now, output, pointing_, slew()));
  output.pixel.x() += config_.search_sd_px;
  EXPECT_FALSE(search_.is_where_slewed(now, output, pointing_, slew()));
  EXPECT_FALSE(search_.is_where_slewed(now, output, pointing_, std::nullopt));
}

// The target is anywhere on the line, also where the slew's own direction is outside the picture.
TEST_F(SlewSearchTest, AlongALineItLooksWhereTheLineCrossesThePicture) {
  auto along = slew(20.0);
  along->line = {1.0, 0.0};
  search_.restart(false);
  const camera::Frame now = frame(1.0);
  const auto place = search_.send_tracker(now, pointing_, along);
  ASSERT_TRUE(place);
  const CameraIntrinsics& camera = config_.geometry.camera;
  EXPECT_NEAR(place->pixel.x(), camera.cx_px, 1.0);
  EXPECT_NEAR(place->pixel.y(), camera.cy_px, 40.0) << "a horizontal line from there";
  EXPECT_EQ(place->sd_px, max_search_sd_px(config_));
  tracker::TrackerOutput output;
  output.pixel = {5.0, place->pixel.y() + 3.0 * config_.search_sd_px};
  EXPECT_TRUE(search_.is_where_slewed(now, output, pointing_, along));
  output.pixel.y() += 2.0 * config_.search_sd_px;
  EXPECT_FALSE(search_.is_where_slewed(now, output, pointing_, along)) << "beside the line";
  along->direction.elevation_rad = radians(20.0);
  search_.restart(false);
  EXPECT_FALSE(search_.send_tracker(now, pointing_, along)) << "it passes above the picture";
}

TEST_F(SlewSearchTest, ItsOwnTargetComesFirst) {
  test::ScriptedTracker::Script script;
  FollowedTarget target(config_, std::make_unique<test::ScriptedTracker>(script));
  EXPECT_TRUE(search_.looks_for_anything(target)) << "it has none";
  ASSERT_FALSE(target.designate(frame(0.0), {10, 10, 20, 20}));
  in_view(1.0, 1.0 + config_.own_target_s);
  EXPECT_FALSE(search_.looks_for_anything(target));
  in_view(1.5 + config_.own_target_s, 1.5 + config_.own_target_s);
  EXPECT_TRUE(search_.looks_for_anything(target));
  search_.end_trial(1.5 + config_.own_target_s);
  EXPECT_FALSE(search_.looks_for_anything(target)) << "its own has its time again";
  target.try_found(frame(8.0), {10, 10, 20, 20});
  in_view(8.0, 30.0);
  EXPECT_FALSE(search_.looks_for_anything(target)) << "one trial at a time";
}

TEST_F(SlewSearchTest, AcquiresNothingWhereThatIsSwitchedOff) {
  config_.acquire_by_slew = false;
  const SlewSearch off(config_);
  test::ScriptedTracker::Script script;
  EXPECT_FALSE(off.looks_for_anything(
      FollowedTarget(config_, std::make_unique<test::ScriptedTracker>(script))));
}

TEST_F(SlewSearchTest, AlarmsAfterALongSlewWithoutATarget) {
  in_view(1.0, 0.5 + config_.unacquired_alarm_s);
  EXPECT_EQ(search_.unacquired_alarm(slew()), "");
  in_view(1.0 + config_.unacquired_alarm_s, 1.0 + config_.unacquired_alarm_s);
  EXPECT_NE(search_.unacquired_alarm(slew()).find("slewed for 10 s"), std::string::npos);
  EXPECT_EQ(search_.unacquired_alarm(std::nullopt), "") << "the slew has ended";
  EXPECT_EQ(search_.unacquired_alarm(slew(0.0, 1.0)), "") << "it may be outside of the picture";
  auto along = slew();
  along->line = {1.0, 0.0};
  EXPECT_EQ(search_.unacquired_alarm(along), "") << "nobody knows where on the line it is";
  search_.restart(true);
  EXPECT_EQ(search_.unacquired_alarm(slew()), "") << "it tracks";
}

TEST_F(SlewSearchTest, ALongGapBeginsTheWaitAnew) {
  in_view(1.0, 8.0);
  in_view(10.5, 11.0);  // 2.5 s: a late slew
  EXPECT_NE(search_.unacquired_alarm(slew()), "");
  in_view(14.5, 15.0);
  EXPECT_EQ(search_.unacquired_alarm(slew()), "");
}

}  // namespace
}  // namespace ols::station
