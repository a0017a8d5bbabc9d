#include "sim/world/trajectory_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/config/toml_config.h"
#include "geometry/angles.h"
#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

class TrajectoryFile : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::unique_ptr<Trajectory> load(const std::string& text) const {
    std::ofstream(path_) << text;
    return load_trajectory_file(path_, site_);
  }
  // Without the folder.
  std::string error_of(const std::string& text) const {
    try {
      load(text);
    } catch (const ConfigError& error) {
      return std::string(error.what()).substr(temp_dir().size());
    }
    return "";
  }
  LocalFrame site_{{radians(49.0), radians(16.0), 300.0}};
  const std::string path_ =
      temp_dir() + testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(TrajectoryFile, BeginsAtItsFirstRow) {
  const auto path = load("utime_us,lat,lon,h\n1000000,49,16,350\n3000000,49,16,370\n");
  EXPECT_LT((path->at(0.0).p_enu - Eigen::Vector3d(0, 0, 50)).norm(), 1e-6);
  EXPECT_LT((path->at(2.0).p_enu - Eigen::Vector3d(0, 0, 70)).norm(), 1e-6);
}

// The columns are tested with the other CSV files (tests/unit/base/files/csv_files_test.cpp).
TEST_F(TrajectoryFile, ABadRowIsAnErrorOfTheConfiguration) {
  EXPECT_EQ(error_of("utime_us,lat,lon,h\n1,49,16,350\n2,149,16,350\n"),
            "ABadRowIsAnErrorOfTheConfiguration:3: lat: 149 is outside -90 .. 90");
}

}  // namespace
}  // namespace ols::sim
