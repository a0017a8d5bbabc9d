#include "tools/calibrate/target_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/config/toml_config.h"
#include "geometry/angles.h"
#include "tests/unit/temporary_folder.h"

namespace ols::calibration {
namespace {

RectificationTargets read(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.path() + "/targets.toml";
  std::ofstream(path) << text;
  return read_targets(path);
}

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const ConfigError& error) {
    const std::string what = error.what();
    return what.substr(what.find("targets.toml"));
  }
  return "";
}

TEST(TargetFile, OnlyWhatStandsThereIsPutUp) {
  const RectificationTargets all = read(
      "[level_line]\nlevel_sd_deg = 0.01\n[cross]\ndistance_m = 25\napart_m = 0.12\n"
      "[rulers]\nnear_m = 20\nfar_m = 40\nbar_m = 0.04\n");
  EXPECT_NEAR(all.level->level_sd_rad, radians(0.01), 1e-12);
  EXPECT_EQ(all.cross->apart_m, 0.12);
  EXPECT_EQ(all.rulers->far_m, 40.0);
  EXPECT_EQ(all.rulers->sd_m, 0.001);
  const RectificationTargets one = read("[level_line]\n");
  EXPECT_TRUE(one.level);
  EXPECT_FALSE(one.cross || one.rulers);
}

TEST(TargetFile, WhatIsWrongIsNamed) {
  EXPECT_NE(refusal("[rulers]\nnear_m = 40\nfar_m = 20\n").find("are the two exchanged?"),
            std::string::npos);
  EXPECT_NE(refusal("[rulers]\nnear_m = 20\nfar_m = 22\n").find("not a fifth larger"),
            std::string::npos);
  EXPECT_NE(refusal("[cross]\n").find("distance_m"), std::string::npos);
  EXPECT_NE(refusal("[cross]\ndistance_m = 20\nwidth_m = 0.2\n").find("width_m"),
            std::string::npos);
  EXPECT_NE(refusal("[ruler]\n").find("ruler"), std::string::npos);
  EXPECT_NE(refusal("").find("one target is needed"), std::string::npos);
}

}  // namespace
}  // namespace ols::calibration
