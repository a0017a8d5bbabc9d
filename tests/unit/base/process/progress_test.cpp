#include "base/process/progress.h"

#include <gtest/gtest.h>

#include <sstream>

namespace ols {
namespace {

TEST(Progress, SaysHowFarLongWorkHasComeEveryFewSeconds) {
  std::ostringstream said;
  double now_s = 100.0;
  Progress progress("ols-track", "frames", said, [&now_s] { return now_s; });
  for (std::size_t frame = 0; frame < 90; ++frame, now_s += 0.125) progress(frame, 400);
  EXPECT_EQ(said.str(),
            "ols-track: 40 of 400 frames after 5 s\nols-track: 80 of 400 frames after 10 s\n");
  now_s += 10.0;
  said.str("");
  progress(7, 0);
  EXPECT_EQ(said.str(), "ols-track: 7 frames after 21 s\n");
}

}  // namespace
}  // namespace ols
