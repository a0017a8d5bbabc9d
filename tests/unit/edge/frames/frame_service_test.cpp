#include "edge/frames/frame_service.h"

#include <gtest/gtest.h>

namespace ols::station {
namespace {

constexpr double kCount_rad = 5.61e-5;

class FrameServiceTest : public testing::Test {
 protected:
  FrameServiceTest() { pointing.set_limits({.count = {kCount_rad, kCount_rad}}); }
  // The unit's report at an instant [s], in counts.
  void unit(double time_s, double pan, double tilt) {
    mount::AngleSample sample;
    sample.time_s = time_s;
    sample.time_sd_s = 1e-4;
    sample.angles = {pan * kCount_rad, tilt * kCount_rad};
    pointing.add(sample);
  }
  void stands(double from_s, double to_s, double pan, double tilt) {
    for (double time_s = from_s; time_s < to_s; time_s += 0.025) unit(time_s, pan, tilt);
  }
  void frame(double mid_s) {
    camera::Frame one;
    one.gray = cv::Mat::zeros(4, 4, CV_8U);
    one.mid_exposure_s = mid_s;
    service.on_frame(one);
  }
  static FrameRequest wanted(std::int64_t boot_id = 1) {
    FrameRequest request;
    request.boot_id = boot_id;
    request.expires_s = 100.0;
    return request;
  }

  std::vector<RequestedFrame> take(double now_s) { return service.take(now_s, pointing); }

  PointingModel pointing{StationConfig{}};
  FrameService service;
};

TEST_F(FrameServiceTest, AFrameHasTheCountsOfItsExposureAndTheDirectionOfTheApproach) {
  for (int i = 0; i < 20; ++i) unit(0.025 * i, 100.0 + 40.0 * i, -10.0 * i);
  EXPECT_EQ(service.request(wanted()), "");
  frame(0.4125);
  const auto answers = take(1.0);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_NEAR(answers[0].counts.pan, 100.0 + 40.0 * 16.5, 1e-6);
  EXPECT_NEAR(answers[0].counts.tilt, -165.0, 1e-6);
  EXPECT_NEAR(answers[0].counts.pan_s, 1600.0, 1e-6);
  EXPECT_EQ(answers[0].counts.approach.pan, 1);
  EXPECT_EQ(answers[0].counts.approach.tilt, -1);
  EXPECT_TRUE(take(1.0).empty());  // once
}

TEST_F(FrameServiceTest, NothingIsSentUnasked) {
  stands(0.0, 1.0, 0.0, 0.0);
  frame(0.5);
  EXPECT_TRUE(take(1.0).empty());
}

TEST_F(FrameServiceTest, AFrameWaitsForTheReportAfterItsExposure) {
  stands(0.0, 0.5, 7.0, 8.0);
  EXPECT_EQ(service.request(wanted()), "");
  frame(0.51);
  EXPECT_TRUE(take(0.52).empty());
  unit(0.525, 7.0, 8.0);
  EXPECT_EQ(take(0.53).size(), 1U);
}

TEST_F(FrameServiceTest, TheUnitMustStandWhereItIsWanted) {
  FrameRequest request = wanted();
  request.at = PanTilt{1000.0 * kCount_rad, 0.0};
  request.tolerance_rad = 2.0 * kCount_rad;
  request.still_s = 0.1;
  EXPECT_EQ(service.request(request), "");
  stands(0.0, 0.3, 0.0, 0.0);  // not there
  frame(0.2);
  EXPECT_TRUE(take(0.3).empty());
  for (int i = 0; i < 10; ++i) unit(0.3 + 0.025 * i, 100.0 * i + 90.0, 0.0);
  stands(0.55, 0.8, 1000.0, 0.0);
  frame(0.6);  // there, but it has not stood long enough
  EXPECT_TRUE(take(0.8).empty());
  frame(0.75);
  EXPECT_EQ(take(0.8).size(), 1U);
}

TEST_F(FrameServiceTest, ARequestEndsWithItsLease) {
  FrameRequest request = wanted();
  request.expires_s = 0.4;
  EXPECT_EQ(service.request(request), "");
  stands(0.0, 1.0, 0.0, 0.0);
  frame(0.5);
  EXPECT_TRUE(take(0.6).empty());
}

TEST_F(FrameServiceTest, ANewerRequestOfOneSenderReplacesItAndTooManyAreRefused) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(service.request(wanted(1)), "");
  for (std::int64_t sender = 2; sender <= 4; ++sender) {
    EXPECT_EQ(service.request(wanted(sender)), "");
  }
  EXPECT_NE(service.request(wanted(5)), "");
  stands(0.0, 1.0, 0.0, 0.0);
  frame(0.5);
  EXPECT_EQ(take(0.6).size(), 4U);
}

TEST_F(FrameServiceTest, WhatIsNotARequestIsRefused) {
  FrameRequest request = wanted();
  request.still_s = std::nan("");
  EXPECT_NE(service.request(request), "");
  request = wanted();
  request.at = PanTilt{std::nan(""), 0.0};
  request.tolerance_rad = 1e-4;
  EXPECT_NE(service.request(request), "");
  request.at = PanTilt{};
  request.tolerance_rad = 0.0;
  EXPECT_NE(service.request(request), "");
}

TEST_F(FrameServiceTest, NothingIsInterpolatedAcrossAHoming) {
  stands(0.0, 0.5, 100.0, 0.0);
  EXPECT_EQ(service.request(wanted()), "");
  pointing.forget_angles();
  frame(0.51);
  stands(0.52, 1.0, 300.0, 0.0);
  EXPECT_TRUE(take(1.0).empty()) << "exposed before the first angles after the homing";
}

TEST_F(FrameServiceTest, AfterAHomingCountsAndSideAreThoseOfAfter) {
  for (int i = 0; i < 20; ++i) unit(0.025 * i, 1000.0 - 40.0 * i, 0.0);  // down
  EXPECT_EQ(service.request(wanted()), "");
  pointing.forget_angles();
  for (int i = 0; i < 6; ++i) frame(0.5 + 0.03 * i);  // more than may wait, and none gets angles
  stands(0.7, 1.0, 300.0, 0.0);
  frame(0.9);
  const auto answers = take(1.0);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].frame.mid_exposure_s, 0.9);
  EXPECT_NEAR(answers[0].counts.pan, 300.0, 1e-6);
  EXPECT_EQ(answers[0].counts.approach.pan, 0) << "it has not moved since";
}

TEST_F(FrameServiceTest, BeforeTheCountIsKnownThereIsNoAnswer) {
  pointing.set_limits({});
  EXPECT_EQ(service.request(wanted()), "");
  stands(0.0, 1.0, 0.0, 0.0);
  frame(0.5);
  EXPECT_TRUE(take(0.6).empty());
}

}  // namespace
}  // namespace ols::station
