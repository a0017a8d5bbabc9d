#include "base/append_line.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

TEST(AppendLine, LinesFollowEachOther) {
  const std::filesystem::path path = std::filesystem::path(temp_dir()) / "append_line.jsonl";
  append_line(path, "one");
  append_line(path, "two");
  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "one\ntwo\n");
}

TEST(AppendLine, AFileThatCannotBeWrittenIsNamed) {
  for (const char* const path : {"/nowhere/at/all", "/dev/full"}) {
    try {
      append_line(path, "one");
      FAIL() << path;
    } catch (const std::system_error& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace ols
