#include "tools/calibrate/calibration_csv.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/temp_dir.h"

namespace ols {
namespace {

std::string file_of(const std::string& text) {
  const std::string path = temp_dir() + "calibration_csv_test.csv";
  std::ofstream(path) << text;
  return path;
}

std::string refusal(const std::string& text) {
  try {
    read_references(file_of(text));
  } catch (const CsvError& error) {
    const std::string what = error.what();
    return what.substr(what.find(".csv") + 4);
  }
  return "none";
}

TEST(References, APointAStarAndAPositionInTime) {
  const auto rows = read_references(
      file_of("landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us,ra_deg,dec_deg\n"
              "spire,49,16,300,0.1,,,\npole,,,,,,37.9,89.2\ndrone,49,16,310,0.02,5,,\n"
              "drone,49,16,311,0.02,6,,\n"));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_FALSE(rows[0].utime_us || rows[0].star);
  EXPECT_EQ(std::get<GeodeticCells>(rows[0].place).longitude_deg, 16.0);
  EXPECT_EQ(rows[1].star->dec_deg, 89.2);
  EXPECT_EQ(rows[3].utime_us, 6);
}

TEST(References, BadRowsAreNamed) {
  const std::string head = "landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us\n";
  EXPECT_EQ(refusal(head + "a,49,16,300,0.1,\na,49,16,300,0.1,\n"),
            ":3: landmark: 'a' appears twice");
  EXPECT_EQ(refusal(head + "a,49,16,300,0.1,7\na,49,16,300,0.1,7\n"),
            ":3: utime_us: is not later than in the row before");
  EXPECT_EQ(refusal(head + "a,149,16,300,0.1,\n"), ":2: latitude_deg: 149 is outside -90 .. 90");
  EXPECT_EQ(refusal(head), ":2: row: the file has a header but no rows");
}

TEST(Predictions, AnApproachIsOneOfTwo) {
  const auto rows =
      read_predictions(file_of("pan_counts,tilt_counts,x_px,y_px,approach_pan\n1,2,3,4,-1\n"));
  EXPECT_EQ(rows.at(0).approach_pan, -1);
  EXPECT_EQ(rows.at(0).approach_tilt, 1);
  EXPECT_THROW(
      read_predictions(file_of("pan_counts,tilt_counts,x_px,y_px,approach_pan\n1,2,3,4,0\n")),
      CsvError);
}

}  // namespace
}  // namespace ols
