#include "base/word_memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/eventually.h"

namespace ols {
namespace {

const std::vector<std::string> kWords{"bad", "worse"};

std::string fresh_file() {
  const std::string file = testing::TempDir() + "ols_word_" + std::to_string(::getpid());
  std::filesystem::remove(file);
  return file;
}

TEST(WordMemory, OutlivesItsOwnerUntilItIsCleared) {
  const std::string file = fresh_file();
  EXPECT_EQ(WordMemory(file, kWords).word(), "");
  for (const char* word : {"bad", "worse", "bad", ""}) {
    WordMemory(file, kWords).set(word);
    const WordMemory next(file, kWords);
    EXPECT_EQ(next.word(), word);
    EXPECT_EQ(next.trouble(), "");
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(WordMemory, SaysWhyItCannotRemember) {
  WordMemory memory("/nonexistent/word", kWords);
  EXPECT_EQ(memory.word(), "");
  memory.set("bad");
  EXPECT_EQ(memory.word(), "bad");  // as long as it lives
  EXPECT_TRUE(eventually([&] { return !memory.trouble().empty(); }));
  EXPECT_NE(memory.trouble().find("/nonexistent/word"), std::string::npos) << memory.trouble();
}

TEST(WordMemory, TriesAgainWhatItCouldNotWrite) {
  const std::string folder = fresh_file();
  WordMemory memory(folder + "/word", kWords);
  memory.set("bad");
  ASSERT_TRUE(eventually([&] { return !memory.trouble().empty(); }));
  std::filesystem::create_directories(folder);
  EXPECT_TRUE(eventually([&] { return memory.trouble().empty(); }));
  EXPECT_EQ(WordMemory(folder + "/word", kWords).word(), "bad");
  std::filesystem::remove_all(folder);
}

TEST(WordMemory, TriesALastTimeAtTheEnd) {
  const std::string folder = fresh_file();
  {
    WordMemory memory(folder + "/word", kWords);
    memory.set("bad");
    ASSERT_TRUE(eventually([&] { return !memory.trouble().empty(); }));
    std::filesystem::create_directories(folder);
  }
  EXPECT_EQ(WordMemory(folder + "/word", kWords).word(), "bad");
  std::filesystem::remove_all(folder);
}

TEST(WordMemory, WhatCannotBeReadIsTheGravest) {
  const std::string file = fresh_file();
  std::ofstream(file) << "rubbish\n";
  EXPECT_EQ(WordMemory(file, kWords).word(), "worse");
  EXPECT_EQ(WordMemory(file, kWords).trouble(), file + ": cannot be read");
  std::ofstream(file, std::ios::trunc);  // the power went while it was written
  EXPECT_EQ(WordMemory(file, kWords).word(), "worse");
  std::filesystem::remove(file);
  const WordMemory unknown(std::string(300, 'x'), kWords);  // longer than names may be
  EXPECT_EQ(unknown.word(), "worse");
  EXPECT_NE(unknown.trouble(), "");
}

TEST(WordMemory, WithoutAFileNothingIsRemembered) {
  WordMemory memory("", kWords);
  memory.set("worse");
  EXPECT_EQ(memory.word(), "worse");
  EXPECT_EQ(memory.trouble(), "");
  EXPECT_EQ(WordMemory("", kWords).word(), "");
}

}  // namespace
}  // namespace ols
