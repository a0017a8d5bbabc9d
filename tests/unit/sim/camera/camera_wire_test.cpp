// The simulated camera and the station's camera over the real wire, on 127.0.0.1 alone.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/unit/sim/camera/camera_rig.h"

namespace ols {
namespace {

TEST(CameraWire, PicturesArriveAsTheyWereDrawn) {
  const auto server = serve();
  camera::AravisCamera camera(station_camera());
  const auto frame = frame_of(camera);
  ASSERT_TRUE(frame) << camera.facts().last_error;
  ASSERT_EQ(frame->gray.size(), cv::Size(kWidth, kHeight));
  ASSERT_EQ(frame->gray.type(), CV_8UC1);
  EXPECT_EQ(frame->gray.at<std::uint8_t>(100, 200), (200 + 2 * 100) / 8);
  EXPECT_EQ(frame->gray.at<std::uint8_t>(kHeight - 1, kWidth - 1),
            (kWidth - 1 + 2 * (kHeight - 1)) / 8);
  EXPECT_EQ(camera.facts().state, camera::CameraState::kStreaming);
  EXPECT_EQ(camera.facts().counters.frames_refused, 0U);
}

TEST(CameraWire, MidExposureIsThatOfTheCamera) {
  const auto server = serve();
  camera::AravisCamera camera(station_camera());
  std::uint64_t number = 0;
  for (int i = 0; i < 10; ++i) {
    const auto frame = frame_of(camera);
    ASSERT_TRUE(frame) << camera.facts().last_error;
    EXPECT_EQ(frame->stamp_source, camera::StampSource::kCamera);
    EXPECT_LT(std::abs(frame->mid_exposure_s - true_middle_s(*frame)),
              4.0 * frame->stamp_sd_s + 1e-3);
    EXPECT_LT(frame->stamp_sd_s, 5e-3);  // bare arrivals would leave 10 ms
    EXPECT_GT(frame->number, number);
    number = frame->number;
  }
}

TEST(CameraWire, AStampAtTheEndOfTheExposureIsTakenAsSuch) {
  const auto server = serve();
  camera::AravisConfig config = station_camera();
  config.stamp_at = camera::StampAt::kExposureEnd;
  camera::AravisCamera camera(config);
  const auto frame = frame_of(camera);
  ASSERT_TRUE(frame) << camera.facts().last_error;
  // The simulated camera stamps the start: read as the end, the middle is an exposure earlier.
  EXPECT_NEAR(true_middle_s(*frame) - frame->mid_exposure_s, kExposure_s,
              4.0 * frame->stamp_sd_s + 1e-3);
}

TEST(CameraWire, WithoutThePacketSocketAndWithSmallPackets) {
  const auto server = serve();
  camera::AravisConfig config = station_camera();
  config.packet_socket = false;
  config.packet_size = 1500;
  camera::AravisCamera camera(config);
  const auto frame = frame_of(camera);
  ASSERT_TRUE(frame) << camera.facts().last_error;
  EXPECT_EQ(frame->gray.at<std::uint8_t>(100, 200), (200 + 2 * 100) / 8);
}

TEST(CameraWire, ColourBecomesGray) {
  // ITU-R BT.601's weights of what the simulated scene's tint leaves.
  const double level = (200 + 2 * 100) / 8;
  const auto& tint = sim::SimulatedCamera::kTint;
  const double brightness = level * (0.299 * tint[0] + 0.587 * tint[1] + 0.114 * tint[2]);
  const auto server = serve();
  for (const char* format : {"BayerRG8", "BayerGR8", "BayerGB8", "BayerBG8", "RGB8", "BGR8"}) {
    camera::AravisConfig config = station_camera();
    config.pixel_format = format;
    camera::AravisCamera camera(config);
    const auto frame = frame_of(camera);
    ASSERT_TRUE(frame) << format << ": " << camera.facts().last_error;
    ASSERT_EQ(frame->gray.size(), cv::Size(kWidth, kHeight));
    for (const cv::Point at : {cv::Point(200, 100), cv::Point(201, 100)})
      EXPECT_NEAR(frame->gray.at<std::uint8_t>(at), brightness, 1.5) << format;
  }
}

TEST(CameraWire, IsFoundByItsName) {
  const auto server = serve();
  camera::AravisConfig config = station_camera();
  config.device = "AVT-T1";
  camera::AravisCamera camera(config);
  ASSERT_TRUE(frame_of(camera)) << camera.facts().last_error;
}

TEST(CameraWire, ASensorTooSmallIsAFault) {
  const auto server = serve({.width_px = 160, .height_px = 120});
  camera::AravisCamera camera(station_camera());
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().state == camera::CameraState::kFault; }));
  EXPECT_NE(camera.facts().last_error.find("320x240"), std::string::npos)
      << camera.facts().last_error;
  EXPECT_EQ(camera.facts().counters.frames_captured, 0U);
}

TEST(CameraWire, FramesOfAnotherSizeAreRefusedAndCounted) {
  const auto server = serve();
  camera::AravisCamera camera(station_camera());
  ASSERT_TRUE(frame_of(camera)) << camera.facts().last_error;
  server->set_size(160, 120);
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().counters.frames_refused >= 3; }));
  EXPECT_EQ(camera.facts().state, camera::CameraState::kFault);
  EXPECT_EQ(camera.facts().last_error, "frame refused: wrong size");
  server->set_size(kWidth, kHeight);
  EXPECT_TRUE(
      becomes(camera, [&] { return camera.facts().state == camera::CameraState::kStreaming; }));
}

// As after two seconds in which the station got no processor.
TEST(CameraWire, FramesThatNobodyTakesAreLateAndOnlyTheNewestIsHandedOut) {
  const auto server = serve();
  camera::AravisCamera camera(station_camera());
  const auto first = frame_of(camera);
  ASSERT_TRUE(first) << camera.facts().last_error;
  const double end_s = clock_s(CLOCK_MONOTONIC) + kDeadline_s;
  while (camera.facts().counters.frames_late < 40 && clock_s(CLOCK_MONOTONIC) < end_s) pause();
  EXPECT_GE(camera.facts().counters.frames_late, 40U);
  const auto frame = camera.next(0.0);
  ASSERT_TRUE(frame);
  EXPECT_GE(frame->number, first->number + 40);
  const auto next = camera.next(kDeadline_s);
  ASSERT_TRUE(next);
  EXPECT_GT(next->number, frame->number);
}

TEST(CameraWire, ACameraThatVanishesIsOpenedAgain) {
  auto server = serve();
  camera::AravisCamera camera(station_camera());
  const auto before = frame_of(camera);
  ASSERT_TRUE(before) << camera.facts().last_error;
  server.reset();
  EXPECT_TRUE(
      becomes(camera, [&] { return camera.facts().state == camera::CameraState::kAbsent; }));
  EXPECT_NE(camera.facts().last_error, "");
  while (camera.next(0.0)) {
  }
  server = serve();
  const auto after = frame_of(camera);
  ASSERT_TRUE(after) << camera.facts().last_error;
  EXPECT_GT(after->number, before->number);
  EXPECT_GE(camera.facts().counters.reconnects, 1U);
  EXPECT_LT(std::abs(after->mid_exposure_s - true_middle_s(*after)),
            4.0 * after->stamp_sd_s + 1e-3);
}

TEST(CameraWire, AnAbsentCameraIsWaitedForAndTheStationCanEnd) {
  camera::AravisCamera camera(station_camera());
  EXPECT_FALSE(camera.next(0.0));
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().last_error != ""; }));
  EXPECT_EQ(camera.facts().state, camera::CameraState::kAbsent);
  EXPECT_EQ(camera.facts().counters.reconnects, 0U);
}

// The camera keeps its last master for a heartbeat of 3 s; this one is cut off for longer.
TEST(CameraWire, ACameraThatWasCutOffIsBackSoonAfterTheCableIs) {
  const auto server = serve();
  camera::AravisCamera camera(station_camera());
  ASSERT_TRUE(frame_of(camera)) << camera.facts().last_error;
  const double cut_s = clock_s(CLOCK_MONOTONIC);
  server->set_faults({.gone = true, .pixel_format = {}});
  EXPECT_TRUE(
      becomes(camera, [&] { return camera.facts().state == camera::CameraState::kAbsent; }));
  EXPECT_TRUE(becomes(camera, [&] { return clock_s(CLOCK_MONOTONIC) > cut_s + 5.0; }));
  server->set_faults({});
  const double back_s = clock_s(CLOCK_MONOTONIC);
  EXPECT_TRUE(
      becomes(camera, [&] { return camera.facts().state == camera::CameraState::kStreaming; }));
  RecordProperty("seconds_to_recover", std::to_string(clock_s(CLOCK_MONOTONIC) - back_s));
  // Without the farewell to the lost camera in the background it takes eight seconds more.
  EXPECT_LT(clock_s(CLOCK_MONOTONIC) - back_s, 6.0);
  EXPECT_EQ(camera.facts().counters.reconnects, 1U);
}

TEST(CameraWire, LostPacketsSpoilFramesOnlyWhereTheyCannotBeSentAgain) {
  const auto server = serve();
  camera::AravisConfig config = station_camera();
  config.packet_size = 1500;  // 53 packets a frame
  server->set_faults({.packet_loss = 0.01, .no_resend = true, .pixel_format = {}});
  camera::AravisCamera camera(config);
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().counters.frames_incomplete >= 3; }));
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().counters.frames_captured >= 3; }));
  EXPECT_NE(camera.facts().last_error.find("incomplete"), std::string::npos)
      << camera.facts().last_error;
  EXPECT_TRUE(becomes(camera, [&] { return has_alarm(camera, "of the frames incomplete"); }));
}

TEST(CameraWire, LostPacketsAreAskedForAgain) {
  const auto server = serve();
  camera::AravisConfig config = station_camera();
  config.packet_size = 1500;
  server->set_faults({.packet_loss = 0.01, .pixel_format = {}});
  camera::AravisCamera camera(config);
  ASSERT_TRUE(becomes(camera, [&] { return camera.facts().counters.frames_captured >= 20; }));
  EXPECT_LE(camera.facts().counters.frames_incomplete, camera.facts().counters.frames_captured / 5);
}

TEST(SimulatedCamera, KeepsThePixelFormatOfItsFaultFromTheNextConnectionOn) {
  const auto server = serve();
  camera::AravisCamera camera(station_camera());
  ASSERT_TRUE(frame_of(camera)) << camera.facts().last_error;
  server->set_faults({.pixel_format = "BayerRG8"});
  EXPECT_TRUE(frame_of(camera)) << camera.facts().last_error;
  server->set_faults({.gone = true, .pixel_format = "BayerRG8"});
  EXPECT_TRUE(
      becomes(camera, [&] { return camera.facts().state == camera::CameraState::kAbsent; }));
  server->set_faults({.pixel_format = "BayerRG8"});
  EXPECT_TRUE(becomes(camera, [&] { return camera.facts().state == camera::CameraState::kFault; }));
  EXPECT_TRUE(has_alarm(camera, "camera: insists on pixel format BayerRG8 instead of Mono8"));
  server->set_faults({});
  EXPECT_TRUE(becomes(camera, [&] {
    return camera.facts().state == camera::CameraState::kStreaming;
  })) << camera.facts().last_error;
}

TEST(SimulatedCamera, AnAddressThatIsTakenIsAnError) {
  const auto server = serve();
  EXPECT_THROW(serve(), std::system_error);
}

}  // namespace
}  // namespace ols
