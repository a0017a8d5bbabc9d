#include "export/outlet/file_link.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/files/small_file.h"

namespace ols::exports {
namespace {

TEST(FileLink, WhatIsBesideTheFileStandsBeforeTheEndOfItsName) {
  EXPECT_EQ(file_name("/srv/site.kml", ""), "/srv/site.kml");
  EXPECT_EQ(file_name("/srv/site.kml", "-live"), "/srv/site-live.kml");
  EXPECT_EQ(file_name("/srv/a.b/site", "-live"), "/srv/a.b/site-live");
}

TEST(FileLink, WritesWholeFilesAndSaysWhyItCannot) {
  const auto folder =
      std::filesystem::temp_directory_path() /
      ("ols_file_link_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()));
  std::filesystem::create_directories(folder);
  FileLink link((folder / "a.txt").string());
  link.open();
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  link.send({"document", "text", "-live"});
  EXPECT_EQ(read_small_file((folder / "a-live.txt").string(), 100), "text");
  std::filesystem::remove_all(folder);
  EXPECT_THROW(link.send({"document", "text"}), LinkError);
  EXPECT_THROW(link.open(), LinkError) << "it must not seem to work again";
}

}  // namespace
}  // namespace ols::exports
