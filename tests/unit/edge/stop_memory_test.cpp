#include "edge/stop_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace ols {
namespace {

std::string fresh_file() {
  const std::string file = testing::TempDir() + "ols_stop_" + std::to_string(::getpid());
  std::filesystem::remove(file);
  return file;
}

TEST(StopMemory, OutlivesItsOwnerUntilItIsCleared) {
  const std::string file = fresh_file();
  EXPECT_FALSE(StopMemory(file).pending());
  StopMemory(file).set(true);
  StopMemory next(file);
  EXPECT_TRUE(next.pending());
  next.set(false);
  EXPECT_FALSE(next.pending());
  EXPECT_FALSE(StopMemory(file).pending());
}

TEST(StopMemory, SaysWhyItCannotRemember) {
  StopMemory memory("/nonexistent/stop");
  EXPECT_FALSE(memory.pending());
  memory.set(true);
  EXPECT_TRUE(memory.pending());  // as long as it lives
  EXPECT_EQ(memory.trouble(), "/nonexistent/stop: No such file or directory");
}

// A name that is too long stands for a disk that cannot be read: nobody can tell whether there was
// a stop.
TEST(StopMemory, WhatCannotBeReadCountsAsAStop) {
  const StopMemory memory(std::string(300, 'x'));
  EXPECT_TRUE(memory.pending());
  EXPECT_NE(memory.trouble(), "");
}

TEST(StopMemory, WithoutAFileNothingIsRemembered) {
  StopMemory memory("");
  memory.set(true);
  EXPECT_TRUE(memory.pending());
  EXPECT_EQ(memory.trouble(), "");
  EXPECT_FALSE(StopMemory("").pending());
}

}  // namespace
}  // namespace ols
