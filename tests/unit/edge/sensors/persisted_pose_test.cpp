#include "edge/sensors/persisted_pose.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <variant>

#include "base/files/fnv1a.h"
#include "geometry/angles.h"

namespace ols::sensors {
namespace {

PersistedPose example() {
  PersistedPose pose;
  pose.position = {{radians(49.2266123456789), radians(-16.5969), 310.25},
                   {0.021, 0.022, 0.043},
                   1'700'000'000'123'456};
  pose.tilt = {{radians(0.12), radians(-0.08)}, radians(0.01), 1'700'000'000'654'321};
  return pose;
}

std::string error_of(const std::string& text) {
  const auto read = persisted_pose_from(text);
  return std::holds_alternative<std::string>(read) ? std::get<std::string>(read) : "none";
}

// With the sum that belongs to it: a writer's mistake, not a damaged disk.
std::string summed(const std::string& lines) {
  const std::string text = "ols-pose 1\n" + lines;
  char sum[32];
  std::snprintf(sum, sizeof sum, "sum %016lx\n", static_cast<unsigned long>(fnv1a(text)));
  return text + sum;
}

TEST(PersistedPose, ComesBackAsItWas) {
  const PersistedPose pose = example();
  const auto read = persisted_pose_from(to_text(pose));
  ASSERT_TRUE(std::holds_alternative<PersistedPose>(read)) << std::get<std::string>(read);
  const auto& again = std::get<PersistedPose>(read);
  ASSERT_TRUE(again.position && again.tilt);
  EXPECT_NEAR(again.position->ground.latitude_rad, pose.position->ground.latitude_rad, 1e-13);
  EXPECT_NEAR(again.position->ground.longitude_rad, pose.position->ground.longitude_rad, 1e-13);
  EXPECT_NEAR(again.position->ground.height_m, 310.25, 1e-6);
  EXPECT_NEAR((again.position->sd_enu_m - pose.position->sd_enu_m).norm(), 0.0, 1e-7);
  EXPECT_EQ(again.position->utime_us, 1'700'000'000'123'456);
  EXPECT_NEAR((again.tilt->tilt_rad - pose.tilt->tilt_rad).norm(), 0.0, 1e-10);
  EXPECT_NEAR(again.tilt->sd_rad, pose.tilt->sd_rad, 1e-9);
  EXPECT_EQ(again.tilt->utime_us, 1'700'000'000'654'321);
}

TEST(PersistedPose, APartMayBeMissing) {
  PersistedPose pose = example();
  pose.tilt.reset();
  const auto read = persisted_pose_from(to_text(pose));
  ASSERT_TRUE(std::holds_alternative<PersistedPose>(read));
  EXPECT_TRUE(std::get<PersistedPose>(read).position);
  EXPECT_FALSE(std::get<PersistedPose>(read).tilt);
}

TEST(PersistedPose, EveryCutAndEveryWrongByteIsSeen) {
  const std::string text = to_text(example());
  for (std::size_t i = 0; i < text.size(); ++i) {
    EXPECT_NE(error_of(text.substr(0, i)), "none") << i;
    std::string wrong = text;
    wrong[i] = static_cast<char>(wrong[i] ^ 1);
    EXPECT_NE(error_of(wrong), "none") << i;
  }
  EXPECT_NE(error_of(text + "x"), "none");
}

TEST(PersistedPose, NumbersThatAreNoPoseAreRefusedByTheirLine) {
  const std::string good = "tilt 0.1 0.1 0.01 17\n";
  EXPECT_EQ(error_of(summed(good)), "none");
  for (const char* bad :
       {"tilt 91 0.1 0.01 17\n", "tilt nan 0.1 0.01 17\n", "tilt 0.1 0.1 0 17\n",
        "tilt 0.1 0.1 0.01 -1\n", "tilt 0.1 0.1 0.01\n", "tilt 0.1 0.1 0.01 17 18\n",
        "position 91 0 0 1 1 1 17\n", "position 1 2 3 1 1 inf 17\n", "position 1 2 3 1 1 -1 17\n",
        "heading 3\n", "\n"}) {
    EXPECT_EQ(error_of(summed(bad)), "line 2: is neither a position nor a tilt") << bad;
  }
  EXPECT_EQ(error_of(summed(good + good)), "line 3: is neither a position nor a tilt");
}

}  // namespace
}  // namespace ols::sensors
