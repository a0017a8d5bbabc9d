#include "edge/camera/camera_handover.h"

#include <gtest/gtest.h>

#include <thread>

#include "conditions/alarms.h"

namespace ols::camera {
namespace {

Frame numbered(std::uint64_t number) {
  Frame frame;
  frame.gray = cv::Mat(2, 2, CV_8U, cv::Scalar(0));
  frame.number = number;
  return frame;
}

class CameraHandoverTest : public testing::Test {
 protected:
  CameraHandover handover_;
  FrameStatistics statistics_;
};

TEST_F(CameraHandoverTest, HandsOverTheNewestFrameOnce) {
  EXPECT_FALSE(handover_.next(0.0));
  handover_.publish(numbered(1), 0, statistics_);
  handover_.publish(numbered(2), 0, statistics_);
  EXPECT_EQ(handover_.next(0.0)->number, 2U);
  EXPECT_FALSE(handover_.next(0.0));
  EXPECT_EQ(handover_.facts().counters.frames_captured, 2U);
  EXPECT_EQ(handover_.facts().counters.frames_late, 1U) << "the first was never taken";
}

TEST_F(CameraHandoverTest, AFrameWithoutPixelsReplacesNone) {
  handover_.publish(numbered(1), 0, statistics_);
  handover_.publish(Frame{}, 0, statistics_);
  EXPECT_EQ(handover_.next(0.0)->number, 1U);
}

TEST_F(CameraHandoverTest, AFrameWakesWhoWaitsForIt) {
  std::thread camera([this] { handover_.publish(numbered(7), 0, statistics_); });
  const auto frame = handover_.next(60.0);
  camera.join();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->number, 7U);
}

TEST_F(CameraHandoverTest, TheEndWakesTheCamerasThread) {
  std::thread camera([this] { handover_.wait(3600.0); });
  handover_.end();
  camera.join();
  EXPECT_TRUE(handover_.ended());
}

TEST_F(CameraHandoverTest, ATriggerIsTakenOnce) {
  EXPECT_FALSE(handover_.take_trigger());
  handover_.ask_trigger();
  handover_.ask_trigger();
  EXPECT_TRUE(handover_.take_trigger());
  EXPECT_FALSE(handover_.take_trigger());
}

TEST_F(CameraHandoverTest, AGoodFrameEndsAFault) {
  handover_.note_refused(PictureRefusal::kWrongSize, 0, statistics_);
  EXPECT_EQ(handover_.facts().state, CameraState::kFault);
  EXPECT_EQ(handover_.facts().fault, "camera: frames are refused: frame refused: wrong size");
  handover_.publish(numbered(1), 0, statistics_);
  EXPECT_EQ(handover_.facts().state, CameraState::kStreaming);
  EXPECT_EQ(handover_.facts().fault, "");
  EXPECT_EQ(handover_.facts().last_error, "frame refused: wrong size")
      << "what was last wrong stays known";
}

TEST_F(CameraHandoverTest, CountsEachKindOfLoss) {
  handover_.publish(numbered(5), 3, statistics_);
  handover_.note_incomplete(2, statistics_);
  handover_.note_refused(PictureRefusal::kWrongSize, 1, statistics_);
  const CameraFacts facts = handover_.facts();
  EXPECT_EQ(facts.counters.frames_lost, 6U);
  EXPECT_EQ(facts.counters.frames_incomplete, 1U);
  EXPECT_EQ(facts.counters.frames_refused, 1U);
  EXPECT_EQ(facts.errors, 1U) << "a frame that is lost or incomplete now and then is no error";
}

TEST_F(CameraHandoverTest, ALostCameraHasNoFrameRate) {
  statistics_.add(1.0, true);
  statistics_.add(1.1, true);
  handover_.publish(numbered(1), 0, statistics_);
  EXPECT_GT(handover_.facts().frame_rate_hz, 5.0);
  handover_.note_failure(CameraState::kAbsent, alarm::camera_lost_answer());
  EXPECT_EQ(handover_.facts().frame_rate_hz, 0.0);
  EXPECT_EQ(handover_.facts().fault, "") << "absent, not faulty";
  EXPECT_EQ(handover_.facts().last_error, alarm::camera_lost_answer().reason());
}

}  // namespace
}  // namespace ols::camera
