#include "base/fix_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace ols {
namespace {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(FixWriter, LeavesTheOldFileUntilItCommits) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("fix_writer_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = folder / "fixes.csv";
  std::ofstream(path) << "old";
  FixRow fix;
  fix.target = "a";
  fix.height_m = -12.34565;
  {
    FixWriter writer(path);
    writer.add(fix);
  }
  EXPECT_EQ(text_of(path), "old");
  FixWriter writer(path);
  writer.add(fix);
  writer.add(fix);
  EXPECT_EQ(text_of(path), "old");
  writer.commit();
  const std::string written = text_of(path);
  EXPECT_EQ(std::ranges::count(written, '\n'), 3);
  EXPECT_NE(written.find("\n0,a,0.000000000,0.000000000,-12.345"), std::string::npos) << written;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace ols
