#include "tools/doctor/kept_list.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/trust/key_file.h"
#include "tests/unit/base/trust/site_fixture.h"
#include "tests/unit/temp_dir.h"

namespace ols::doctor {
namespace {

namespace fs = std::filesystem;

TEST(KeptList, IsReadWhereThereIsNoOther) {
  const fs::path folder = fs::path(temp_dir()) / ("kept" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const trust::Environment environment{.keys = folder.string(), .state = folder.string()};
  EXPECT_EQ(with_kept_list({}, environment, "alfa").list, "");
  const trust::Site site;
  trust::write_member_key((folder / "alfa.key").string(),
                          {"alfa", trust::seed_of(2), site.secret, site.root.public_key()});
  std::ofstream(folder / "trust-alfa.toml") << trust::sign_list(site.list(), site.stranger);
  EXPECT_EQ(with_kept_list({}, environment, "alfa").list, "") << "of another site";
  std::ofstream(folder / "trust-alfa.toml") << trust::sign_list(site.list(), site.root);
  EXPECT_EQ(with_kept_list({}, environment, "alfa").list, (folder / "trust-alfa.toml").string());
  EXPECT_EQ(with_kept_list({}, environment, "bravo").list, "");
  std::ofstream(folder / "trust.toml") << "x";
  EXPECT_EQ(with_kept_list({}, environment, "alfa").list, "") << "the centre's own";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace ols::doctor
