#include "base/process/status_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(StatusFile, IsRewrittenAsAWhole) {
  const std::string path = temp_dir() + "status.json";
  StatusFile file(path);
  file.write("{\"long\": 1}");
  EXPECT_EQ(text_of(path), "{\"long\": 1}\n");
  file.write("{}");
  EXPECT_EQ(text_of(path), "{}\n");
}

TEST(StatusFile, AFailureEndsNothingAndTheNextWriteTriesAgain) {
  const std::string folder = temp_dir() + "later";
  StatusFile file(folder + "/status.json");
  EXPECT_NO_THROW(file.write("{}"));
  std::filesystem::create_directory(folder);
  file.write("{}");
  EXPECT_EQ(text_of(folder + "/status.json"), "{}\n");
}

TEST(StatusFile, WithoutAPathNothingIsWritten) { EXPECT_NO_THROW(StatusFile("").write("{}")); }

}  // namespace
}  // namespace ols
