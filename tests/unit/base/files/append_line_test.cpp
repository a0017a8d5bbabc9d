#include "base/files/append_line.h"

#include <gmock/gmock.h>
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
    EXPECT_THAT([&] { append_line(path, "one"); },
                testing::ThrowsMessage<std::system_error>(testing::HasSubstr(path)));
  }
}

}  // namespace
}  // namespace ols
