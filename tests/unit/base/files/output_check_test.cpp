#include "base/files/output_check.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

namespace fs = std::filesystem;

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

}  // namespace
}  // namespace ols
