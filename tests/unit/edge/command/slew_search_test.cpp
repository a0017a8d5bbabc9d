#include "edge/command/slew_search.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <utility>
#include <vector>

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

// A detector's object, confirmed after half a second on this way.
detector::Tracklet object(long id, const Eigen::Vector2d& pixel,
                          const Eigen::Vector2d& velocity_px_s = Eigen::Vector2d::Zero()) {
  constexpr double kImage_s = 0.1;
  constexpr int kImages = 6;
  detector::Detection detection;
  detection.size_px = {8.0, 6.0};
  detection.clear = true;
  detection.pixel = pixel - (kImages - 1) * kImage_s * velocity_px_s;
  detector::Tracklet tracklet(id, detection, 1280.0);
  for (int i = 1; i < kImages; ++i) {
    detection.pixel += kImage_s * velocity_px_s;
    tracklet.predict(Eigen::Matrix3d::Identity(), kImage_s);
    tracklet.update(detection);
  }
  tracklet.confirm(true);
  return tracklet;
}

class AcquisitionOfTracklets : public SlewSearchTest {
 protected:
  // Empty sky: the station's own look at the images finds nothing.
  std::optional<SlewSearch::Acquired> acquired(std::vector<detector::Tracklet> objects,
                                               const SlewSearch::Slew& slew, double now_s = 1.2) {
    frames_ = {frame(1.0), frame(now_s)};
    for (camera::Frame& one : frames_) one.gray = cv::Mat(960, 1280, CV_8U, cv::Scalar(150));
    return search_.acquire(frames_, detector::Found{1.0, std::move(objects), false}, pointing_,
                           slew);
  }
  const Eigen::Vector2d middle_{639.5, 479.5};
  std::deque<camera::Frame> frames_;
};

TEST_F(AcquisitionOfTracklets, TheOnlyOneThatBehavesAsTheSlewIsChosenInTheImageThatShowsIt) {
  const auto there = acquired({object(1, {1100, 200}), object(2, {644, 484})}, slew());
  ASSERT_TRUE(there);
  EXPECT_EQ(there->frame->mid_exposure_s, 1.0);
  EXPECT_NEAR(there->box.x + 0.5 * there->box.width, 644.5, 0.1);
  EXPECT_NEAR(there->box.y + 0.5 * there->box.height, 484.5, 0.1);
  EXPECT_GT(there->box.width, 8.0);
  search_.begin_trial(*there);
  EXPECT_EQ(search_.counters().at("acquisitions_by_tracklet"), 1.0);
}

TEST_F(AcquisitionOfTracklets, OneElsewhereOrOfOtherSpeedIsNot) {
  EXPECT_FALSE(acquired({object(1, {1100, 200})}, slew()));
  EXPECT_FALSE(acquired({object(1, middle_, {400.0, 0.0})}, slew()));
  SlewSearch::Slew moving = slew();
  moving->effect_s = 1.0;
  moving->azimuth_rate_rad_s = 400.0 / config_.geometry.camera.fx_px;
  EXPECT_TRUE(acquired({object(1, middle_, {400.0, 0.0})}, moving));
}

TEST_F(AcquisitionOfTracklets, OfTwoNoneIs) {
  EXPECT_FALSE(acquired({object(1, {640, 480}), object(2, {660, 480})}, slew()));
}

TEST_F(AcquisitionOfTracklets, AnOldResultIsNone) {
  EXPECT_FALSE(acquired({object(1, middle_)}, slew(), 1.6));
}

TEST_F(AcquisitionOfTracklets, AlongALineItMustMove) {
  SlewSearch::Slew line = slew();
  line->line = {1.0, 0.0};
  EXPECT_FALSE(acquired({object(1, {900, 480})}, line));
  EXPECT_TRUE(acquired({object(1, {900, 480}, {100.0, 0.0})}, line));
  EXPECT_FALSE(acquired({object(1, {900, 700}, {100.0, 0.0})}, line)) << "beside it";
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
  EXPECT_NE(search_.unacquired_alarm(slew()).text.find("not found for 10 s"), std::string::npos);
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
