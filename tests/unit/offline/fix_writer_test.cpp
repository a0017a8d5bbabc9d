#include "tools/offline/fix_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "tests/unit/folder_test.h"

namespace ols {
namespace {

namespace fs = std::filesystem;

class FixWriterTest : public FolderTest<std::filesystem::path> {
 protected:
  void SetUp() override { path_ = folder_ / "fixes.csv"; }

  std::string content() const {
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }

  std::string path_;
};

FixRow a_fix() {
  FixRow fix;
  fix.utime_us = 1600000000200000;
  fix.target = "1";
  fix.latitude_deg = 49.1234567894;
  fix.longitude_deg = -16.5;
  fix.height_m = 266.63494;
  fix.east_sd_m = 0.13;
  fix.stations_used = 3;
  return fix;
}

TEST_F(FixWriterTest, WritesEveryColumn) {
  FixWriter writer(path_);
  writer.add(a_fix());
  writer.commit();
  EXPECT_EQ(content(),
            "utime_us,target,latitude_deg,longitude_deg,height_m,east_sd_m,north_sd_m,up_sd_m,"
            "stations_used,stations_set_aside,crossing_angle_deg,residual\n"
            "1600000000200000,1,49.123456789,-16.500000000,266.6349,0.1300,0.0000,0.0000,3,0,"
            "0.0000,0.0000\n");
}

TEST_F(FixWriterTest, LeavesAResidualThatIsNoneEmpty) {
  FixRow fix = a_fix();
  fix.residual = std::numeric_limits<double>::quiet_NaN();
  FixWriter writer(path_);
  writer.add(fix);
  writer.commit();
  EXPECT_TRUE(content().ends_with(",0.0000,\n")) << content();
}

TEST_F(FixWriterTest, KeepsTheOldFileUntilItIsCommitted) {
  std::ofstream(path_) << "old";
  {
    FixWriter writer(path_);
    writer.add(a_fix());
  }
  EXPECT_EQ(content(), "old");
}

TEST_F(FixWriterTest, NamesAFolderThatIsMissing) {
  EXPECT_THROW(FixWriter(folder_ / "absent" / "fixes.csv"), std::system_error);
}

}  // namespace
}  // namespace ols
