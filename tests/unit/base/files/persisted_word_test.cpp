#include "base/files/persisted_word.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/unit/eventually.h"
#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

const std::vector<std::string> kWords{"good", "bad", "worse"};

class PersistedWordTest : public testing::Test {
 protected:
  PersistedWordTest() {
    folder = temp_dir() + "ols_word_" + std::to_string(::getpid());
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    file = folder + "/word";
  }
  ~PersistedWordTest() override { std::filesystem::remove_all(folder); }

  std::string content() const {
    std::string text;
    std::getline(std::ifstream(file), text);
    return text;
  }

  std::string folder, file;
};

TEST_F(PersistedWordTest, OutlivesItsOwner) {
  for (const char* word : {"good", "worse", "bad", "good"}) {
    PersistedWord(file, kWords).set(word);
    const PersistedWord next(file, kWords);
    EXPECT_EQ(next.restore_result(), RestoreResult::kKnown);
    EXPECT_EQ(next.word(), word);
    EXPECT_EQ(next.why_unknown(), "");
    EXPECT_EQ(next.trouble(), "");
  }
}

// "Nothing to remember" is written, too: an absent file means that the state is unknown.
TEST_F(PersistedWordTest, AFileOrFolderThatIsNotThereIsUnknown) {
  const PersistedWord without_file(file, kWords);
  EXPECT_EQ(without_file.restore_result(), RestoreResult::kMissing);
  EXPECT_EQ(without_file.word(), "");
  EXPECT_EQ(without_file.why_unknown(), file + " is missing");
  const PersistedWord without_folder("/nonexistent/word", kWords);
  EXPECT_EQ(without_folder.restore_result(), RestoreResult::kMissing);
  EXPECT_EQ(without_folder.why_unknown(), "/nonexistent is missing");
}

TEST_F(PersistedWordTest, WhatCannotBeReadIsUnknown) {
  std::ofstream(file) << "rubbish\n";
  EXPECT_EQ(PersistedWord(file, kWords).restore_result(), RestoreResult::kUnreadable);
  EXPECT_EQ(PersistedWord(file, kWords).why_unknown(), file + ": is damaged");
  std::ofstream(file, std::ios::trunc);  // the power went while it was written
  EXPECT_EQ(PersistedWord(file, kWords).restore_result(), RestoreResult::kUnreadable);
  const PersistedWord unknown(std::string(300, 'x'), kWords);  // longer than names may be
  EXPECT_EQ(unknown.restore_result(), RestoreResult::kUnreadable);
  EXPECT_NE(unknown.why_unknown().find("too long"), std::string::npos) << unknown.why_unknown();
}

TEST_F(PersistedWordTest, SaysWhyItCannotRemember) {
  PersistedWord memory("/nonexistent/word", kWords);
  memory.set("bad");
  EXPECT_EQ(memory.word(), "bad");  // as long as it lives
  EXPECT_TRUE(eventually([&] { return !memory.trouble().empty(); }));
  EXPECT_NE(memory.trouble().find("/nonexistent/word"), std::string::npos) << memory.trouble();
  EXPECT_FALSE(std::filesystem::exists("/nonexistent")) << "and makes no folder";
}

TEST_F(PersistedWordTest, TriesAgainWhatItCouldNotWrite) {
  std::filesystem::remove_all(folder);
  PersistedWord memory(file, kWords);
  memory.set("bad");
  ASSERT_TRUE(eventually([&] { return !memory.trouble().empty(); }));
  std::filesystem::create_directories(folder);
  EXPECT_TRUE(eventually([&] { return memory.trouble().empty(); }));
  EXPECT_EQ(PersistedWord(file, kWords).word(), "bad");
}

TEST_F(PersistedWordTest, AFolderThatVanishesWhileItRunsIsATroubleUntilItIsBack) {
  for (const bool known : {false, true}) {  // a word that was set, one that was found
    PersistedWord memory(file, kWords);
    if (!known) memory.set("worse");
    ASSERT_TRUE(eventually([&] { return content() == "worse"; }));
    std::filesystem::rename(folder, folder + ".away");
    ASSERT_TRUE(eventually([&] { return !memory.trouble().empty(); }));
    std::filesystem::create_directories(folder);
    EXPECT_TRUE(eventually([&] { return memory.trouble().empty() && content() == "worse"; }));
    std::filesystem::remove_all(folder + ".away");
  }
}

TEST_F(PersistedWordTest, AFileThatIsTakenAwayOrChangedIsWrittenAgain) {
  PersistedWord memory(file, kWords);
  memory.set("worse");
  ASSERT_TRUE(eventually([&] { return content() == "worse"; }));
  std::filesystem::remove(file);
  EXPECT_TRUE(eventually([&] { return content() == "worse"; }));
  std::ofstream(file, std::ios::trunc) << "good\n";
  EXPECT_TRUE(eventually([&] { return content() == "worse"; }));
}

TEST_F(PersistedWordTest, TriesALastTimeAtTheEnd) {
  std::filesystem::remove_all(folder);
  {
    PersistedWord memory(file, kWords);
    memory.set("bad");
    ASSERT_TRUE(eventually([&] { return !memory.trouble().empty(); }));
    std::filesystem::create_directories(folder);
  }
  EXPECT_EQ(PersistedWord(file, kWords).word(), "bad");
}

TEST_F(PersistedWordTest, WithoutAFileNothingIsRemembered) {
  PersistedWord memory("", kWords);
  EXPECT_EQ(memory.restore_result(), RestoreResult::kNoFile);
  memory.set("worse");
  EXPECT_EQ(memory.word(), "worse");
  EXPECT_EQ(memory.trouble(), "");
  EXPECT_EQ(PersistedWord("", kWords).word(), "");
}

}  // namespace
}  // namespace ols
