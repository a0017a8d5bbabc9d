// The recorder with its thread and a real folder. Nothing is judged by how long it took.
#include "edge/recorder/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "base/process/clocks.h"
#include "tests/unit/edge/recorder/recorder_files.h"
#include "tests/unit/eventually.h"

namespace ols::recorder {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    config.folder = folder / "events";
    config.disk_reserve_bytes = 0.0;
  }

  // The camera: a frame every 0.1 s of the past, then of the future, as if time flew.
  void film(Recorder& recorder, int frames, int side_px = 64) {
    for (int i = 0; i < frames; ++i, ++number) {
      const RecordedFrame r =
          noisy_frame(number, start_s + 0.1 * static_cast<double>(number), side_px);
      camera::Frame frame;
      frame.gray = r.picture;
      frame.mid_exposure_s = r.mid_exposure_s;
      frame.stamp_sd_s = r.sd_s;
      frame.number = number;
      recorder.add(frame, r.utime_us);
    }
  }
  double time_of(int frame) const { return start_s + 0.1 * frame; }

  std::set<std::string> events() const {
    auto names = names_in(config.folder);
    names.erase(".removal");
    return names;
  }
  bool has_events(std::size_t count) {
    return eventually([&] {
      const auto names = events();
      return names.size() == count &&
             std::ranges::none_of(names, [](const auto& n) { return n.ends_with(".partial"); });
    });
  }
  std::uint64_t count(const Recorder& recorder, const char* name) const {
    return recorder.report().counters.at(name);
  }
  bool counts(const Recorder& recorder, const char* name, std::uint64_t value) const {
    return eventually([&] { return count(recorder, name) == value; });
  }
  // Numbers of the frames in the table of the only event.
  std::string table() const {
    return content_of(std::filesystem::path(config.folder) / *events().begin() / "frames.csv");
  }
  static std::size_t rows(const std::string& table) {
    return static_cast<std::size_t>(std::ranges::count(table, '\n')) - 1;
  }

  const TemporaryFolder folder;
  RecorderConfig config;
  double start_s = clock_monotonic_s() - 20.0;
  std::uint64_t number = 0;
};

TEST_F(RecorderTest, KeepsTheFramesAroundAnEvent) {
  start_s = clock_monotonic_s() - 10.0;  // the event's end is yet to come
  Recorder recorder(config);
  film(recorder, 100);
  EXPECT_EQ(recorder.record({time_of(80), 2.05, 3.05, "gust"}), "");
  film(recorder, 100);  // the event ends with the first frame after it
  ASSERT_TRUE(has_events(1));
  EXPECT_THAT(*events().begin(), HasSubstr("Z_gust"));
  const std::string rows_text = table();
  EXPECT_EQ(rows(rows_text), 51U);  // 60..110
  EXPECT_THAT(rows_text, HasSubstr(",60,"));
  EXPECT_THAT(rows_text, HasSubstr(",110,"));
  EXPECT_THAT(rows_text, testing::Not(HasSubstr(",59,")));
  EXPECT_THAT(rows_text, testing::Not(HasSubstr(",111,")));
  EXPECT_TRUE(counts(recorder, "recorder_events_written", 1));
  EXPECT_EQ(count(recorder, "recorder_frames_written"), 51U);
  EXPECT_EQ(count(recorder, "recorder_frames_dropped"), 0U);
  EXPECT_TRUE(eventually([&] { return recorder.report().readings.at("recorder_events") == 1.0; }));
  EXPECT_GT(recorder.report().readings.at("disk_free_bytes"), 0.0);
}

TEST_F(RecorderTest, TwoEventsThatOverlapBothHaveAll) {
  Recorder recorder(config);
  film(recorder, 100);
  EXPECT_EQ(recorder.record({time_of(90), 1.0, 2.0, "a"}), "");
  EXPECT_EQ(recorder.record({time_of(95), 1.0, 2.0, "b"}), "");
  film(recorder, 50);
  EXPECT_TRUE(counts(recorder, "recorder_events_written", 2));
  EXPECT_TRUE(has_events(2));
}

TEST_F(RecorderTest, WithoutAFolderItRefuses) {
  Recorder recorder(RecorderConfig{});
  EXPECT_THAT(recorder.record({clock_monotonic_s(), 1.0, 1.0, ""}), HasSubstr("no recorder"));
  EXPECT_EQ(count(recorder, "recorder_commands_refused"), 1U);
}

TEST_F(RecorderTest, AnEventWithoutAFrameLeavesNothingAndIsCounted) {
  Recorder recorder(config);
  EXPECT_EQ(recorder.record({clock_monotonic_s(), 1.0, 0.3, ""}), "");
  EXPECT_TRUE(counts(recorder, "recorder_events_failed", 1));
  EXPECT_THAT(events(), ElementsAre());
}

// Six commands must not empty the store.
TEST_F(RecorderTest, RecordingsDoNotPushOutWhatIsThere) {
  config.quota_bytes = 4096.0 * 25;  // two events of ten frames of 4 kB and a little
  Recorder recorder(config);
  ASSERT_TRUE(eventually([&] { return recorder.report().state == device::DeviceState::kOk; }));
  film(recorder, 100);
  int accepted = 0;
  for (int i = 0; i < 6; ++i) {
    const std::string label{'e', static_cast<char>('0' + i)};
    const std::string why = recorder.record({time_of(60 + 5 * i), 0.45, 0.45, label});
    if (why.empty()) {
      ++accepted;
      ASSERT_TRUE(counts(recorder, "recorder_events_written", static_cast<std::uint64_t>(i) + 1));
      ASSERT_TRUE(eventually([&] {
        return recorder.report().readings.at("recorder_events") == static_cast<double>(accepted);
      }));
    } else {
      EXPECT_THAT(why, HasSubstr("no space"));
    }
  }
  EXPECT_GE(accepted, 2);
  EXPECT_LT(accepted, 6);
  EXPECT_THAT(*events().begin(), HasSubstr("_e0"));
  EXPECT_EQ(count(recorder, "recorder_events_removed"), 0U);
  EXPECT_EQ(count(recorder, "recorder_refused_no_room"), static_cast<std::uint64_t>(6 - accepted));
  EXPECT_THAT(recorder.report().alarms,
              testing::Contains(HasSubstr("recorder: recordings are refused, the quota is full")));
  std::filesystem::remove_all(std::filesystem::path(config.folder) / *events().begin());
  EXPECT_TRUE(eventually([&] { return recorder.report().alarms.empty(); })) << "room was made";
}

TEST_F(RecorderTest, OfManyRecordingsInAShortTimeAFewAreMade) {
  Recorder recorder(config);
  film(recorder, 100);
  std::uint64_t accepted = 0;
  for (int i = 0; i < 20; ++i) {
    const std::string why = recorder.record({time_of(90), 0.05, 0.05, ""});
    if (why.empty()) {
      ASSERT_TRUE(counts(recorder, "recorder_events_written", ++accepted));
    } else {
      EXPECT_THAT(why, HasSubstr("too many"));
    }
  }
  EXPECT_GE(accepted, 8U);
  EXPECT_EQ(count(recorder, "recorder_refused_too_many"), 20U - accepted);
  EXPECT_GE(count(recorder, "recorder_refused_too_many"), 1U);
}

TEST_F(RecorderTest, AFullDiskIsReportedAndNothingIsWritten) {
  config.disk_reserve_bytes = 1e18;
  Recorder recorder(config);
  film(recorder, 50);
  ASSERT_TRUE(eventually([&] { return !recorder.report().alarms.empty(); }));
  const device::DeviceReport report = recorder.report();
  EXPECT_EQ(report.state, device::DeviceState::kFault);
  EXPECT_THAT(report.alarms[0], testing::MatchesRegex("recorder: disk full \\(.* GB free\\)"));
  EXPECT_THAT(report.last_error, HasSubstr("disk full"));
  EXPECT_THAT(recorder.record({time_of(40), 1.0, 1.0, ""}), HasSubstr("disk full"));
  EXPECT_THAT(events(), ElementsAre());
}

TEST_F(RecorderTest, AFolderThatCannotBeWrittenHealsByItself) {
  std::ofstream(config.folder) << "in the way";
  Recorder recorder(config);
  film(recorder, 50);
  ASSERT_TRUE(eventually([&] { return !recorder.report().alarms.empty(); }));
  EXPECT_NE(recorder.record({time_of(40), 1.0, 1.0, ""}), "");
  std::filesystem::remove(config.folder);
  ASSERT_TRUE(eventually([&] { return recorder.report().alarms.empty(); }));
  EXPECT_EQ(recorder.record({time_of(40), 1.0, 1.0, ""}), "");
  EXPECT_TRUE(has_events(1));
  EXPECT_NE(recorder.report().last_error, "");
}

TEST_F(RecorderTest, AFolderThatVanishesInAnEventCostsFramesOnly) {
  Recorder recorder(config);
  film(recorder, 190);
  EXPECT_EQ(recorder.record({clock_monotonic_s(), 2.0, 20.0, ""}), "");
  ASSERT_TRUE(eventually([&] { return count(recorder, "recorder_frames_written") > 0; }));
  ASSERT_TRUE(eventually([&] {  // while frames come in, so that it may take more than one try
    std::error_code ignored;
    std::filesystem::remove_all(config.folder, ignored);
    std::ofstream(config.folder) << "in the way";
    return std::filesystem::is_regular_file(config.folder);
  }));
  film(recorder, 20);
  ASSERT_TRUE(eventually([&] { return count(recorder, "recorder_frames_dropped") > 0; }));
  std::filesystem::remove(config.folder);
  ASSERT_TRUE(eventually([&] { return recorder.report().alarms.empty(); }));
  film(recorder, 10);
  film(recorder, 300);  // beyond the event
  EXPECT_TRUE(has_events(1));
}

TEST_F(RecorderTest, EventsAtTheSameTimeDoNotTakeEachOthersRoom) {
  config.quota_bytes = 4096.0 * 400;  // one event of 310 frames of 4 kB
  config.memory_s = 100.0;
  Recorder recorder(config);
  ASSERT_TRUE(eventually([&] { return recorder.report().state == device::DeviceState::kOk; }));
  film(recorder, 150);
  EXPECT_EQ(recorder.record({time_of(145), 0.95, 30.0, "a"}), "");
  EXPECT_THAT(recorder.record({time_of(145), 0.95, 30.0, "b"}), HasSubstr("no space"));
  ASSERT_TRUE(counts(recorder, "recorder_frames_written", 14));
  number = 500;
  film(recorder, 1);  // it ends, and took less than was thought
  EXPECT_TRUE(counts(recorder, "recorder_events_written", 1));
  EXPECT_EQ(count(recorder, "recorder_events_removed"), 0U);
  EXPECT_TRUE(has_events(1));
}

// An event with all its frames on the disk, that ends with the next frame of close_last().
class RecorderEndTest : public RecorderTest {
 protected:
  RecorderEndTest() {
    config.memory_s = 100.0;
    start_s = clock_monotonic_s() - 10.0;
  }
  void record_open(Recorder& recorder, const char* label) {
    film(recorder, 100);
    ASSERT_EQ(recorder.record({time_of(90), 0.45, 30.0, label}), "");
    ASSERT_TRUE(counts(recorder, "recorder_frames_written", 14));
  }
  void close_open(Recorder& recorder) {
    number = 500;
    film(recorder, 1);
  }
  std::string record_next(Recorder& recorder) const {
    return recorder.record({time_of(90), 0.45, 0.45, "next"});
  }
  // As it will be called.
  std::string whole_name() const {
    const std::string partial = std::filesystem::path(config.folder) / *events().begin();
    return partial.substr(0, partial.size() - std::string(".partial").size());
  }
};

TEST_F(RecorderEndTest, AnEventThatVanishesBeforeItsEndCostsNoOther) {
  Recorder recorder(config);
  record_open(recorder, "gone");
  std::filesystem::remove_all(whole_name() + ".partial");
  close_open(recorder);
  EXPECT_TRUE(counts(recorder, "recorder_events_failed", 1));
  EXPECT_THAT(recorder.report().last_error, HasSubstr("_gone vanished"));
  EXPECT_EQ(record_next(recorder), "");
  EXPECT_TRUE(counts(recorder, "recorder_events_written", 1));
  ASSERT_TRUE(has_events(1));
  EXPECT_THAT(*events().begin(), HasSubstr("_next"));
}

TEST_F(RecorderEndTest, AnEventThatCannotBeFinishedWaitsAndTheOthersGoOn) {
  Recorder recorder(config);
  record_open(recorder, "stuck");
  const std::string in_the_way = whole_name();
  std::filesystem::create_directories(in_the_way + "/x");
  close_open(recorder);
  ASSERT_TRUE(eventually([&] { return !recorder.report().alarms.empty(); }));
  EXPECT_THAT(recorder.report().alarms[0], HasSubstr("Directory not empty"));
  for (std::uint64_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(record_next(recorder), "");
    EXPECT_TRUE(counts(recorder, "recorder_events_written", i));
  }
  EXPECT_FALSE(recorder.report().alarms.empty());
  std::filesystem::remove_all(in_the_way);
  EXPECT_TRUE(counts(recorder, "recorder_events_written", 6));
  EXPECT_TRUE(eventually([&] { return recorder.report().alarms.empty(); }));
  EXPECT_EQ(count(recorder, "recorder_events_failed"), 0U);
}

TEST_F(RecorderTest, WhatTheDiskCannotKeepUpWithIsDropped) {
  constexpr int kSide_px = 1024;
  config.memory_max_bytes = 3.5 * kSide_px * kSide_px;
  Recorder recorder(config);
  EXPECT_EQ(recorder.record({clock_monotonic_s(), 30.0, 30.0, ""}), "");
  ASSERT_TRUE(eventually([&] {
    film(recorder, 1, kSide_px);
    return count(recorder, "recorder_frames_dropped") > 0;
  }));
  EXPECT_EQ(recorder.report().last_error, "the disk is too slow");
}

TEST_F(RecorderTest, WhatIsRecordedWhenTheStationStopsIsKept) {
  {
    Recorder recorder(config);
    film(recorder, 195);
    EXPECT_EQ(recorder.record({clock_monotonic_s(), 2.0, 50.0, ""}), "");
  }
  ASSERT_TRUE(has_events(1));
  EXPECT_GE(rows(table()), 10U);
}

TEST_F(RecorderTest, OfABayerCameraTheMosaicIsKept) {
  Recorder recorder(config);
  ASSERT_TRUE(eventually([&] { return recorder.report().state == device::DeviceState::kOk; }));
  const RecordedFrame mosaic = noisy_frame(1, start_s);
  camera::Frame frame;
  frame.gray = cv::Mat::zeros(mosaic.picture.size(), CV_8UC1);
  frame.raw = mosaic.picture;
  frame.pixel_format = "BayerRG8";
  frame.mid_exposure_s = start_s;
  recorder.add(frame, mosaic.utime_us);
  EXPECT_EQ(recorder.record({start_s, 1.0, 0.0, "raw"}), "");
  ASSERT_TRUE(has_events(1));
  const auto folder_of_event = std::filesystem::path(config.folder) / *events().begin();
  EXPECT_THAT(content_of(folder_of_event / "frames.csv"), HasSubstr(",BayerRG8,camera\n"));
  const std::string png = folder_of_event / (std::to_string(mosaic.utime_us) + ".png");
  const cv::Mat read = cv::imread(png, cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.size(), mosaic.picture.size());
  EXPECT_EQ(cv::norm(read, mosaic.picture, cv::NORM_L1), 0.0);
}

// As under the unit's filter of system calls, and of this thread and its children alone.
bool refuse_setpriority() {
  sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_setpriority, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog filter{std::size(program), program};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

TEST_F(RecorderTest, APriorityThatCannotBeLoweredIsTold) {
  if (::getpriority(PRIO_PROCESS, 0) >= 10) GTEST_SKIP() << "runs behind everything already";
  bool filtered = false, told = false;
  std::jthread([&] {
    filtered = refuse_setpriority();
    if (!filtered) return;
    const Recorder recorder(config);
    told = eventually([&] {
      return recorder.report().text.ends_with(
          "; runs at the control loop's priority (Operation not permitted)");
    });
  }).join();
  if (!filtered) GTEST_SKIP() << "no filter of system calls here";
  EXPECT_TRUE(told);
}

TEST_F(RecorderTest, ItsThreadStandsBackWhereItMay) {
  const Recorder recorder(config);
  ASSERT_TRUE(eventually([&] { return recorder.report().state == device::DeviceState::kOk; }));
  EXPECT_THAT(recorder.report().text, Not(HasSubstr("priority")));
}

}  // namespace
}  // namespace ols::recorder
