#include "edge/calibration/reference_views.h"

#include <gtest/gtest.h>

#include <map>

#include "geometry/angles.h"
#include "tests/unit/eventually.h"
#include "tests/unit/folder_test.h"
#include "tests/unit/moved_scene.h"

namespace ols::station {
namespace {

const double kCount = radians(11.5714 / 3600.0);

class ReferenceViewsTest : public FolderTest<> {
 protected:
  ReferenceViewsTest() {
    config_.folder = folder_;
    limits_.count = {kCount, kCount};
    config_.station = "alfa";
    config_.calibration_id = 9;
    calibration_.angle_sd_rad = radians(5.0 / 3600.0);
  }

  // Its thread reads the stored pictures, in real time.
  void load(ReferenceViews& views) const {
    views.set_limits(limits_);
    eventually([&] { return views.loaded(); });
  }

  // A unit that is where it is told at once; every scene moved by so many pixels. Until the
  // pictures of the rounds that it asks for are compared.
  void round(ReferenceViews& views, double right_px) {
    load(views);
    views.request();
    const auto before = views.checks();
    const bool storing = !views.stored();
    PanTilt at;
    // Its thread compares, in real time.
    eventually([&] {
      if (views.checks() != before || (storing && views.stored())) return true;
      now_s_ += 0.1;
      const auto goal = views.step({now_s_, true, at});
      if (!goal) return false;
      at = goal->angles;
      camera::Frame frame;
      frame.mid_exposure_s = now_s_;
      frame.gray = seen(static_cast<int>(std::lround(at.pan_rad)), right_px);
      views.see(frame);
      return false;
    });
  }

  // One round whatever comes of it.
  void once(ReferenceViews& views) {
    load(views);
    PanTilt at;
    for (const double end_s = now_s_ + 200.0; now_s_ < end_s; now_s_ += 0.1) {
      const auto goal = views.step({now_s_, true, at});
      if (!goal) continue;
      at = goal->angles;
      camera::Frame frame;
      frame.mid_exposure_s = now_s_;
      frame.gray = seen(static_cast<int>(std::lround(at.pan_rad)), 0.0);
      views.see(frame);
    }
  }

  // Until the pictures of a round are compared: its threads work in real time.
  template <class Condition>
  bool compared(ReferenceViews& views, const Condition& condition) {
    return eventually([&] {
      views.step({now_s_, false, PanTilt{}});
      return condition();
    });
  }

  const cv::Mat& seen(int seed, double right_px) {
    if (night_) return dark_;
    cv::Mat& picture = scenes_[{seed, right_px}];
    if (picture.empty()) picture = moved_scene(seed, right_px);
    return picture;
  }

  std::map<std::pair<int, double>, cv::Mat> scenes_;
  ReferenceViews::Config config_;
  StationCalibration calibration_;
  double now_s_ = 100.0;
  mount::Limits limits_{-radians(159), radians(159), -radians(46), radians(31)};
  bool night_ = false;
  const cv::Mat dark_ = cv::Mat::zeros(480, 640, CV_8U);
};

TEST_F(ReferenceViewsTest, StoresThenFindsAKnockThatOutlivesTheProcess) {
  {
    ReferenceViews views(config_, calibration_);
    round(views, 0.0);
    EXPECT_TRUE(views.stored());
    EXPECT_EQ(views.checks(), 0U);
    round(views, 0.0);
    EXPECT_EQ(views.checks(), 1U);
    EXPECT_TRUE(views.alarms().empty());
  }
  {
    ReferenceViews views(config_, calibration_);
    round(views, 4.3);
    EXPECT_TRUE(views.alarms().empty()) << "one look";
    round(views, 4.3);
    ASSERT_EQ(views.alarms().size(), 1U);
    EXPECT_NE(views.alarms().front().text.find("the tripod has moved"), std::string::npos);
    EXPECT_EQ(views.watch().level(), DriftLevel::kRed);
  }
  const ReferenceViews next(config_, calibration_);
  EXPECT_EQ(next.watch().level(), DriftLevel::kRed);
  config_.calibration_id = 10;
  const ReferenceViews other(config_, calibration_);
  EXPECT_EQ(other.watch().level(), DriftLevel::kNone);
}

TEST_F(ReferenceViewsTest, StoresNoPictureInWhichNothingCouldBeRecognised) {
  ReferenceViews views(config_, calibration_);
  night_ = true;
  once(views);
  EXPECT_FALSE(views.stored());
  now_s_ += 90000.0;
  views.step({now_s_, true, PanTilt{}});
  ASSERT_EQ(views.alarms().size(), 1U);
  EXPECT_NE(views.alarms().front().text.find("not checked for"), std::string::npos);
  night_ = false;
  round(views, 0.0);
  EXPECT_TRUE(views.stored()) << "by day";
  round(views, 0.0);
  EXPECT_EQ(views.checks(), 1U);
  EXPECT_TRUE(views.alarms().empty());
}

// What the calibration says of the sun's place is no better than what is known of the tripod.
TEST_F(ReferenceViewsTest, ATripodThatWasTurnedKeepsFurtherFromTheSun) {
  double asked_rad = 0.0;
  config_.sun = [&asked_rad](const PanTilt&, double turned_rad) {
    asked_rad = turned_rad;
    return false;
  };
  ReferenceViews views(config_, calibration_);
  round(views, 0.0);
  round(views, 0.0);
  EXPECT_EQ(asked_rad, 0.0);
  night_ = true;  // or somewhere else altogether
  views.request();
  once(views);
  EXPECT_TRUE(compared(views, [&] { return views.unrecognised() > 0; }));
  night_ = false;
  views.request();
  for (int i = 0; i < 2; ++i) views.step({now_s_ += 30.0, true, PanTilt{}});
  EXPECT_NEAR(degrees(asked_rad), 30.0, 1e-9);
  for (int i = 0; i < 3; ++i) round(views, 4.3);
  ASSERT_EQ(views.watch().level(), DriftLevel::kRed);
  EXPECT_GT(asked_rad, 2.9 * views.watch().heading_doubt_rad());
  EXPECT_LT(degrees(asked_rad), 1.0);
}

TEST_F(ReferenceViewsTest, AViewBehindTheSunIsCountedAndStoredLater) {
  bool shines = true;
  config_.sun = [&shines](const PanTilt& at, double) { return shines && at.pan_rad > 2.0; };
  ReferenceViews views(config_, calibration_);
  once(views);
  EXPECT_EQ(views.left_out(), 1U);
  shines = false;
  once(views);  // without being asked
  EXPECT_TRUE(compared(views, [&] { return views.stored(); }));
}

TEST_F(ReferenceViewsTest, PicturesOfOtherViewsAreNotTheirs) {
  {
    ReferenceViews views(config_, calibration_);
    round(views, 0.0);
    EXPECT_TRUE(views.stored());
  }
  limits_.pan_max_rad = radians(100);
  ReferenceViews others(config_, calibration_);
  load(others);
  EXPECT_FALSE(others.stored());
}

TEST_F(ReferenceViewsTest, NoRoundBeginsBeforeTheStoredPicturesAreRead) {
  {
    ReferenceViews views(config_, calibration_);
    round(views, 0.0);
  }
  ReferenceViews next(config_, calibration_);
  EXPECT_FALSE(next.loaded());
  next.request();
  EXPECT_FALSE(next.step({now_s_ += 1000.0, true, PanTilt{}})) << "its travel is not known";
  load(next);
  EXPECT_TRUE(next.stored());
  EXPECT_FALSE(next.step({now_s_ += 1000.0, true, PanTilt{}}));
  EXPECT_TRUE(next.step({now_s_ += 1000.0, true, PanTilt{}}));
}

TEST_F(ReferenceViewsTest, FewerThanThreeViewsAreSaid) {
  ReferenceViews views(config_, calibration_);
  limits_.keep_out.push_back({-radians(150), radians(60), -radians(40), radians(31)});
  views.set_limits(limits_);
  ASSERT_EQ(views.alarms().size(), 1U);
  EXPECT_NE(views.alarms().front().text.find("fewer than three"), std::string::npos);
}

}  // namespace
}  // namespace ols::station
