#include "tools/offline/timing_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "tests/unit/temp_dir.h"

namespace ols::offline {
namespace {

TEST(TimingCsv, ARowIsInMillisecondsWithAColumnForEachStage) {
  const std::string path = temp_dir() + "timing_csv_test.csv";
  tracker::Tracker tracker({}, 1);
  TimingFile file(path, tracker);
  tracker::StageTimes stages;
  stages.seconds[0] = 0.002;
  file.write(3, 0.0125, stages);
  file.commit();
  std::ifstream in(path);
  std::string header, row;
  std::getline(in, header);
  std::getline(in, row);
  EXPECT_TRUE(header.starts_with("frame,total_ms,")) << header;
  EXPECT_TRUE(row.starts_with("3,12.5,2,")) << row;
  EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(header, ','));
  std::remove(path.c_str());
}

TEST(TimingCsv, AFileThatCannotBeWrittenIsAnError) {
  tracker::Tracker tracker({}, 1);
  EXPECT_ANY_THROW(TimingFile("/nonexistent/timing.csv", tracker));
}

TEST(TimingCsv, TheThreadsTimeNeverRunsBackwards) {
  const double before_s = thread_time_s();
  EXPECT_GT(before_s, 0.0);
  EXPECT_GE(thread_time_s(), before_s);
}

}  // namespace
}  // namespace ols::offline
