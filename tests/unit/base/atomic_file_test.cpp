#include "base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <sstream>
#include <system_error>

namespace ols {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder_);
    std::ofstream(path()) << "old";
  }
  void TearDown() override { fs::remove_all(folder_); }
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
  fs::path folder_;
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
  try {
    AtomicFile file("/nonexistent/out.csv");
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/out.csv"), std::string::npos);
  }
}

TEST_F(AtomicFileTest, DoesNotReplaceWhatIsNoFile) {
  const std::string pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(AtomicFile{pipe}, std::system_error);
  EXPECT_THROW(AtomicFile{folder_.string()}, std::system_error);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

}  // namespace
}  // namespace ols
