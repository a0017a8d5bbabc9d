#include "base/trust/marks_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/folder_test.h"

namespace ols::trust {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class MarksFileTest : public FolderTest<> {
 protected:
  MarksFileTest() { marks_.note({1, 2, 3}, "OLS_BEARING_alfa", head_); }

  // A start after this one.
  bool still_heard(MarksFile& file) const {
    ReplayMarks marks;
    file.read(marks);
    return marks.is_heard({1, 2, 3}, "OLS_BEARING_alfa", head_);
  }

  const std::string path_ = folder_ + "/heard-fusion";
  const MessageHead head_{100, "", 7, 50};
  ReplayMarks marks_;
};

TEST_F(MarksFileTest, TheMarksOutlastARestart) {
  MarksFile file(path_);
  ReplayMarks none;
  file.read(none);
  EXPECT_EQ(file.trouble(), "") << "a first start";
  EXPECT_TRUE(file.is_behind(marks_));
  file.write(marks_.text(), marks_.revision());
  EXPECT_FALSE(file.is_behind(marks_));
  EXPECT_EQ(file.trouble(), "");
  MarksFile next(path_);
  EXPECT_TRUE(still_heard(next));
  EXPECT_EQ(next.trouble(), "");
}

TEST_F(MarksFileTest, NoPathIsNoFile) {
  MarksFile file("");
  EXPECT_FALSE(still_heard(file));
  EXPECT_FALSE(file.is_behind(marks_));
  EXPECT_EQ(file.trouble(), "");
}

TEST_F(MarksFileTest, ADamagedFileIsSaidForAWhileAndTheRestOfItCounts) {
  std::ofstream(path_) << marks_.text() << "nonsense\n";
  MarksFile file(path_, 3);
  EXPECT_TRUE(still_heard(file));
  const auto said = AllOf(HasSubstr("received before this start is lost"), HasSubstr(path_),
                          HasSubstr("1 damaged lines"));
  EXPECT_THAT(file.trouble(), said);
  file.look();
  file.write(marks_.text(), marks_.revision());
  file.look();
  EXPECT_THAT(file.trouble(), said) << "though it has been written anew";
  file.look();
  EXPECT_EQ(file.trouble(), "");
}

TEST_F(MarksFileTest, AFileThatCannotBeReadIsSaid) {
  fs::create_directories(path_);
  MarksFile file(path_);
  EXPECT_FALSE(still_heard(file));
  EXPECT_THAT(file.trouble(), HasSubstr("lost: "));
  std::ofstream(folder_ + "/large") << std::string(MarksFile::kLargest + 1, 'x');
  MarksFile large(folder_ + "/large");
  EXPECT_FALSE(still_heard(large));
  EXPECT_THAT(large.trouble(), HasSubstr("/large"));
}

TEST_F(MarksFileTest, AFailedWriteIsSaidUntilOneSucceeds) {
  const std::string folder = folder_ + "/away";
  MarksFile file(folder + "/heard-fusion");
  file.write(marks_.text(), marks_.revision());
  const auto said =
      AllOf(HasSubstr("cannot be kept for the next start"), HasSubstr("away/heard-fusion"));
  EXPECT_THAT(file.trouble(), said);
  EXPECT_TRUE(file.is_behind(marks_)) << "and is tried again";
  for (int i = 0; i < 2 * MarksFile::kSaid; ++i) file.look();
  EXPECT_THAT(file.trouble(), said);
  fs::create_directories(folder);
  file.write(marks_.text(), marks_.revision());
  EXPECT_EQ(file.trouble(), "");
  file.write(std::string(MarksFile::kLargest + 1, 'x'), 9);
  EXPECT_THAT(file.trouble(), HasSubstr("too large"));
}

}  // namespace
}  // namespace ols::trust
