#include "edge/recorder/event_queue.h"

#include <gtest/gtest.h>

namespace ols::recorder {
namespace {

RecordedFrame frame_at(double time_s) {
  RecordedFrame frame;
  frame.picture = cv::Mat::zeros(10, 10, CV_8U);
  frame.mid_exposure_s = time_s;
  return frame;
}

RecorderConfig config() {
  RecorderConfig config;
  config.folder = "events";
  config.memory_max_bytes = 300.0;  // three frames
  return config;
}

TEST(EventQueue, AnEventTakesFramesOfBeforeAndAfter) {
  EventQueue queue(config());
  for (const double time_s : {10.0, 10.1}) EXPECT_EQ(queue.add(frame_at(time_s)), 0);
  EXPECT_EQ(queue.begin({10.1, 0.05, 0.2, "x"}, 1), 0);
  queue.add(frame_at(10.2));
  queue.add(frame_at(10.4));  // after its end
  for (const double time_s : {10.1, 10.2}) {
    const auto job = queue.next(10.4);
    ASSERT_TRUE(job && job->frame);
    EXPECT_EQ(job->frame->mid_exposure_s, time_s);
  }
  EXPECT_FALSE(queue.work_waits());
  const auto end = queue.next(10.4);
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->frame) << "it is to be finished";
  queue.remove(*end->event);
  EXPECT_TRUE(queue.empty());
}

TEST(EventQueue, DropsFramesThatTheMemoryHasNoRoomFor) {
  EventQueue queue(config());
  queue.begin({10.0, 0.0, 5.0, "x"}, 1);
  int dropped = 0;
  for (int i = 0; i < 5; ++i) dropped += queue.add(frame_at(10.0 + 0.1 * i));
  EXPECT_EQ(dropped, 2);
  queue.next(11.0);
  EXPECT_EQ(queue.add(frame_at(10.9)), 0) << "one was written meanwhile";
}

TEST(EventQueue, AnEventThatCannotBeFinishedLetsTheOthersGoOn) {
  EventQueue queue(config());
  queue.begin({10.0, 0.0, 1.0, "x"}, 1);
  queue.close(20.0);
  const auto end = queue.next(20.0);
  ASSERT_TRUE(end);
  end->event->unfinished = "no space";
  end->event->retry_s = 25.0;
  EXPECT_EQ(queue.unfinished(), "no space");
  EXPECT_FALSE(queue.next(24.0));
  queue.retry_all();
  EXPECT_TRUE(queue.next(24.0));
}

TEST(EventQueue, RecordsOnlyAFewEventsAtOnceAndOnlyWhatItRemembers) {
  EventQueue queue(config());
  EXPECT_EQ(queue.refusal({10.0, 1.0, 1.0, "x"}, 12.0), "no frame of that time is in memory");
  queue.add(frame_at(10.0));
  EXPECT_EQ(queue.refusal({10.0, 1.0, 1.0, "x"}, 12.0), "");
  for (int i = 0; i < 4; ++i) queue.begin({10.0, 1.0, 1.0, "x"}, i);
  EXPECT_EQ(queue.refusal({10.0, 1.0, 1.0, "x"}, 12.0), "busy with 4 events");
}

}  // namespace
}  // namespace ols::recorder
