#include "edge/hold_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace ols {
namespace {

std::string fresh_file() {
  const std::string file = testing::TempDir() + "ols_hold_" + std::to_string(::getpid());
  std::filesystem::remove(file);
  return file;
}

TEST(HoldMemory, OutlivesItsOwnerUntilItIsCleared) {
  const std::string file = fresh_file();
  EXPECT_EQ(HoldMemory(file).hold(), Hold::kNone);
  for (const Hold hold : {Hold::kStopped, Hold::kEmergency, Hold::kStopped, Hold::kNone}) {
    HoldMemory(file).set(hold);
    const HoldMemory next(file);
    EXPECT_EQ(next.hold(), hold);
    EXPECT_EQ(next.trouble(), "");
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(HoldMemory, SaysWhyItCannotRemember) {
  HoldMemory memory("/nonexistent/hold");
  EXPECT_EQ(memory.hold(), Hold::kNone);
  memory.set(Hold::kStopped);
  EXPECT_EQ(memory.hold(), Hold::kStopped);  // as long as it lives
  EXPECT_NE(memory.trouble().find("/nonexistent/hold"), std::string::npos) << memory.trouble();
}

TEST(HoldMemory, WhatCannotBeReadIsAnEmergency) {
  const std::string file = fresh_file();
  std::ofstream(file) << "rubbish\n";
  EXPECT_EQ(HoldMemory(file).hold(), Hold::kEmergency);
  EXPECT_EQ(HoldMemory(file).trouble(), file + ": cannot be read");
  std::ofstream(file, std::ios::trunc);  // the power went while it was written
  EXPECT_EQ(HoldMemory(file).hold(), Hold::kEmergency);
  std::filesystem::remove(file);
  const HoldMemory unknown(std::string(300, 'x'));  // longer than names may be
  EXPECT_EQ(unknown.hold(), Hold::kEmergency);
  EXPECT_NE(unknown.trouble(), "");
}

TEST(HoldMemory, WithoutAFileNothingIsRemembered) {
  HoldMemory memory("");
  memory.set(Hold::kEmergency);
  EXPECT_EQ(memory.hold(), Hold::kEmergency);
  EXPECT_EQ(memory.trouble(), "");
  EXPECT_EQ(HoldMemory("").hold(), Hold::kNone);
}

TEST(HoldOf, KeepsWhatOnlyAPersonMayEnd) {
  EXPECT_EQ(hold_of(StationState::kEmergency), Hold::kEmergency);
  EXPECT_EQ(hold_of(StationState::kStopped), Hold::kStopped);
  EXPECT_EQ(hold_of(StationState::kManual), Hold::kStopped);
  for (const auto state : {StationState::kIdle, StationState::kTracking, StationState::kCoasting,
                           StationState::kLost, StationState::kSlewed}) {
    EXPECT_EQ(hold_of(state), Hold::kNone);
  }
}

}  // namespace
}  // namespace ols
