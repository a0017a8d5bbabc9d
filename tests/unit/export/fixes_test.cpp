#include "export/fixes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/files/csv_files.h"
#include "export/gate.h"

namespace ols::exports {
namespace {

std::vector<Target> read(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / "ols_export_fixes_test.csv";
  std::ofstream(path) << text;
  return read_fixes(path.string(), {"brno", [](double, double) { return 46.0; }});
}

TEST(ExportFixes, AreTargetsWithTheirStandardDeviations) {
  const auto targets = read(
      "utime_us,target,latitude_deg,longitude_deg,height_m,east_sd_m,north_sd_m,up_sd_m\n"
      "1000,7,47.5,13.25,100,2,3,5\n2000,balloon,47.5,13.25,101,2,3,5\n");
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_EQ(targets[0].id, 7);
  EXPECT_EQ(targets[0].uid, "brno.target.7");
  EXPECT_DOUBLE_EQ(targets[0].place.above_sea_m(), 54.0);
  EXPECT_EQ(targets[0].covariance_m2, (Covariance{4.0, 0.0, 0.0, 9.0, 0.0, 25.0}));
  EXPECT_EQ(targets[1].uid, "brno.target.balloon");
}

TEST(ExportFixes, WithoutDeviationsTheCovarianceIsUnknown) {
  const auto targets =
      read("utime_us,target,latitude_deg,longitude_deg,height_m\n1000,7,47.5,13.25,100\n");
  EXPECT_TRUE(std::isnan(targets.at(0).covariance_m2[0]));
}

TEST(ExportFixes, LongitudesBeyond180AreThoseInTheWest) {
  const auto targets = read(
      "utime_us,target,latitude_deg,longitude_deg,height_m\n"
      "1000,1,47.5,270.5,1\n1000,2,47.5,-89.5,1\n1000,3,47.5,180,1\n1000,4,47.5,-180,1\n");
  ASSERT_EQ(targets.size(), 4U);
  EXPECT_EQ(targets[0].place.longitude_deg, -89.5);
  EXPECT_EQ(targets[1].place.longitude_deg, -89.5);
  EXPECT_EQ(targets[2].place.longitude_deg, 180.0);
  EXPECT_EQ(targets[3].place.longitude_deg, -180.0);
  EXPECT_TRUE(Gate(GateConfig{}).pass(targets[0])) << "within an area that has no end";
}

TEST(ExportFixes, ABadCellIsNamed) {
  EXPECT_THROW(read("utime_us,target,latitude_deg,longitude_deg,height_m\n1000,7,97.5,1,1\n"),
               CsvError);
}

}  // namespace
}  // namespace ols::exports
