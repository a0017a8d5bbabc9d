#include "edge/process/pose_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/eventually.h"
#include "tests/unit/temp_dir.h"

namespace ols::station {
namespace {

class PoseStoreTest : public testing::Test {
 protected:
  PoseStoreTest() {
    folder = temp_dir() + "pose_memory_" + std::to_string(::getpid());
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    file = folder + "/a.pose";
    pose.position = {{0.85, 0.29, 310.0}, {0.02, 0.02, 0.03}, 1'700'000'000'000'000};
    pose.tilt = {{0.002, -0.001}, 2e-4, 1'700'000'000'000'000};
  }
  ~PoseStoreTest() override { std::filesystem::remove_all(folder); }

  bool holds(const sensors::PersistedPose& wanted) {
    return eventually([&] {
      std::ifstream stream(file);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      return text == to_text(wanted);
    });
  }

  std::string folder, file;
  sensors::PersistedPose pose;
};

TEST_F(PoseStoreTest, WhatIsKeptIsFoundAgain) {
  {
    PoseStore memory(file);
    EXPECT_FALSE(memory.found().position);
    EXPECT_EQ(memory.trouble(), "") << "a file that is not there yet is none";
    memory.keep(pose);
    ASSERT_TRUE(holds(pose));
  }
  const PoseStore again(file);
  ASSERT_TRUE(again.found().position && again.found().tilt);
  EXPECT_NEAR(again.found().position->ground.latitude_rad, 0.85, 1e-13);
  EXPECT_EQ(again.found().position->utime_us, pose.position->utime_us);
  EXPECT_EQ(again.trouble(), "");
}

TEST_F(PoseStoreTest, APartThatIsMissingStaysAsItWasFound) {
  std::ofstream(file) << to_text(pose);
  PoseStore memory(file);
  sensors::PersistedPose tilt_only;
  tilt_only.tilt = {{0.1, 0.1}, 1e-3, 1'700'000'100'000'000};
  memory.keep(tilt_only);
  sensors::PersistedPose both = pose;
  both.tilt = tilt_only.tilt;
  EXPECT_TRUE(holds(both));
  memory.keep({});
  EXPECT_TRUE(holds(both));
}

TEST_F(PoseStoreTest, ADamagedFileIsRefusedUntilItIsWrittenAnew) {
  std::ofstream(file) << "ols-pose 1\nposition 4";
  PoseStore memory(file);
  EXPECT_FALSE(memory.found().position);
  EXPECT_EQ(memory.trouble(), "pose: saved pose refused: " + file + ": is damaged: wrong checksum");
  memory.keep(pose);
  EXPECT_TRUE(eventually([&] { return memory.trouble().empty(); }));
  EXPECT_TRUE(holds(pose));
}

TEST_F(PoseStoreTest, AFolderThatIsNotThereIsATrouble) {
  PoseStore memory(folder + "/none/a.pose");
  memory.keep(pose);
  EXPECT_TRUE(
      eventually([&] { return memory.trouble().text.starts_with("pose: cannot be saved: "); }));
  EXPECT_NE(memory.trouble().text.find("/none/a.pose"), std::string::npos);
}

TEST_F(PoseStoreTest, WithoutAFileNothingIsKept) {
  PoseStore memory("");
  memory.keep(pose);
  EXPECT_EQ(memory.trouble(), "");
}

}  // namespace
}  // namespace ols::station
