#include "base/files/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "tests/unit/folder_test.h"

namespace ols {
namespace {

namespace fs = std::filesystem;

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

}  // namespace
}  // namespace ols
