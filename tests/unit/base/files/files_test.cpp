#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/files/append_line.h"
#include "base/files/atomic_file.h"
#include "base/files/background_file.h"
#include "base/files/output_check.h"
#include "base/files/persisted_word.h"
#include "base/files/small_file.h"
#include "tests/unit/eventually.h"
#include "tests/unit/folder_test.h"
#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

namespace fs = std::filesystem;

TEST(AppendLine, LinesFollowEachOther) {
  const std::filesystem::path path = std::filesystem::path(temp_dir()) / "append_line.jsonl";
  append_line(path, "one");
  append_line(path, "two");
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "one\ntwo\n");
}

TEST(AppendLine, AFileThatCannotBeWrittenIsNamed) {
  for (const char* const path : {"/nowhere/at/all", "/dev/full"}) {
    EXPECT_THAT([&] { append_line(path, "one"); },
                testing::ThrowsMessage<std::system_error>(testing::HasSubstr(path)));
  }
}

TEST(OutputCheck, RefusesAnInputByWhateverName) {
  const fs::path folder = fs::path(temp_dir()) / "output_check";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string input = folder / "in.csv", unborn = folder / "out.csv";
  std::ofstream(input) << "in";
  fs::create_symlink("in.csv", folder / "symbolic");
  fs::create_hard_link(input, folder / "hard");
  for (const char* name : {"in.csv", "symbolic", "hard", "../output_check/in.csv"}) {
    try {
      check_outputs({{"--in", input}}, {{"--output", folder / name}});
      ADD_FAILURE() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with("--output: ")) << error.what();
      EXPECT_TRUE(std::string(error.what()).ends_with("--in " + input)) << error.what();
    }
  }
  EXPECT_NO_THROW(check_outputs({{"--in", input}, {"--config", ""}},
                                {{"--output", unborn}, {"--map", ""}, {"--report", ""}}));
  const std::string again = folder / "." / "out.csv";
  EXPECT_THROW(check_outputs({}, {{"--output", unborn}, {"--map", again}}), std::invalid_argument);
}

class AtomicFileTest : public FolderTest<std::filesystem::path> {
 protected:
  void SetUp() override { std::ofstream(path()) << "old"; }
  std::string path() const { return folder_ / "out.csv"; }
  std::string content() const {
    std::ostringstream text;
    text << std::ifstream(path()).rdbuf();
    return text.str();
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
};

TEST_F(AtomicFileTest, ReplacesOnCommit) {
  AtomicFile file(path());
  file.stream() << "new";
  EXPECT_EQ(content(), "old");
  file.commit();
  EXPECT_EQ(content(), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LeavesTheOldFileWithoutCommit) {
  {
    AtomicFile file(path());
    file.stream() << "half";
  }
  EXPECT_EQ(content(), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, NamesAPathThatCannotBeOpened) {
  EXPECT_THAT(
      [&] { AtomicFile file("/nonexistent/out.csv"); },
      testing::ThrowsMessage<std::system_error>(testing::HasSubstr("/nonexistent/out.csv")));
}

TEST_F(AtomicFileTest, DoesNotReplaceWhatIsNoFile) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(AtomicFile{pipe}, std::system_error);
  EXPECT_THROW(AtomicFile{folder_.string()}, std::system_error);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(AtomicFileTest, WritesThroughASymbolicLink) {
  fs::create_directories(folder_ / "there");
  for (const char* target : {"../out.csv", "new.csv"}) {
    const fs::path link = folder_ / "there" / "link";
    fs::remove(link);
    fs::create_symlink(target, link);
    AtomicFile file(link);
    file.stream() << "new";
    file.commit();
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(fs::is_regular_file(link));
  }
  EXPECT_EQ(content(), "new");
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THROW(AtomicFile{folder_ / "circle"}, std::system_error);
}

TEST_F(AtomicFileTest, KeepsTheModeOfTheFile) {
  fs::permissions(path(), fs::perms::owner_read | fs::perms::owner_write);
  AtomicFile file(path());
  file.commit();
  EXPECT_EQ(fs::status(path()).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

// Both the program that a signal ends, and its temporary file.
TEST_F(AtomicFileTest, ASignalLeavesNoTemporaryFile) {
  const auto end_by_a_signal = [this] {
    remove_temporary_files_on_signals();
    AtomicFile file(path());
    file.stream() << "half";
    ::raise(SIGINT);
  };
  EXPECT_EXIT(end_by_a_signal(), testing::KilledBySignal(SIGINT), "");
  EXPECT_EQ(content(), "old");
  EXPECT_EQ(files(), 1u);
}

class SmallFile : public testing::Test {
 protected:
  SmallFile() : path_(temp_dir() + "ols_small_file_" + std::to_string(::getpid())) {
    std::filesystem::remove_all(path_);
  }
  ~SmallFile() override { std::filesystem::remove_all(path_); }
  std::error_code failure() const {
    try {
      read_small_file(path_, 8);
    } catch (const std::system_error& error) {
      EXPECT_NE(std::string(error.what()).find(path_), std::string::npos) << error.what();
      return error.code();
    }
    return {};
  }
  const std::string path_;
};

TEST_F(SmallFile, IsReadWhole) {
  std::ofstream(path_) << std::string("12\n\0 678", 8);
  EXPECT_EQ(read_small_file(path_, 8), std::string("12\n\0 678", 8));
  EXPECT_LT(read_small_file(path_, 1'000'000).capacity(), 1000U) << "many may be kept";
}

TEST_F(SmallFile, IsNotReadWhenItIsNotSmall) {
  std::ofstream(path_) << "123456789";
  EXPECT_EQ(failure(), std::errc::file_too_large);
}

TEST_F(SmallFile, MissingIsSaid) { EXPECT_EQ(failure(), std::errc::no_such_file_or_directory); }

TEST_F(SmallFile, ANamedPipeKeepsNobodyWaiting) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(failure(), std::errc::invalid_argument);
}

TEST_F(SmallFile, AFolderIsNone) {
  std::filesystem::create_directory(path_);
  EXPECT_EQ(failure(), std::errc::is_a_directory);
}

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

constexpr double kLong_s = 60.0;

class BackgroundFileTest : public FolderTest<std::filesystem::path> {
 protected:
  std::string content() const {
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }
  const fs::path path_ = folder_ / "state";
};

TEST_F(BackgroundFileTest, HoldsTheNewestText) {
  BackgroundFile file(path_);
  for (const char* text : {"one", "two", "three"}) file.write(text);
  ASSERT_TRUE(file.is_written(kLong_s));
  EXPECT_EQ(content(), "three");
  EXPECT_EQ(file.trouble(), "");
}

TEST_F(BackgroundFileTest, ItsEndWaitsForAPendingWrite) {
  { BackgroundFile(path_).write("the last words"); }
  EXPECT_EQ(content(), "the last words");
}

// The folder may be the mount point of a missing disk.
TEST_F(BackgroundFileTest, AMissingFolderIsATroubleAndIsNotMade) {
  fs::remove_all(folder_);
  BackgroundFile file(path_);
  file.write("state");
  EXPECT_FALSE(file.is_written(kLong_s));
  EXPECT_NE(file.trouble(), "");
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(BackgroundFileTest, WhatIsRemovedIsWrittenAgain) {
  BackgroundFile file(path_);
  file.write("state");
  ASSERT_TRUE(file.is_written(kLong_s));
  fs::remove(path_);
  EXPECT_TRUE(eventually([this] { return content() == "state"; }));
}

TEST_F(BackgroundFileTest, WithoutAPathNothingIsWritten) {
  BackgroundFile file("");
  file.write("state");
  EXPECT_TRUE(file.is_written(0.0)) << "nothing is pending";
  EXPECT_EQ(file.trouble(), "");
}

}  // namespace
}  // namespace ols
