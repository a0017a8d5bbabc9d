#include "base/files/csv_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/files/csv_rows.h"
#include "tests/unit/error_text.h"
#include "tests/unit/folder_test.h"

namespace ols {
namespace {

const char* const kStations = "station,latitude_deg,longitude_deg,height_m\n";
const char* const kBearings = "utime_us,station,azimuth_deg,elevation_deg,sigma_deg\n";

class CsvFilesTest : public FolderTest<std::filesystem::path> {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  // The error's text without the folder.
  std::string error_of(const auto& read) const {
    const std::string folder = folder_.string() + "/";
    return error_text<CsvError>(read, folder + "none").substr(folder.size());
  }
  std::string error_of_stations(const std::string& text) const {
    return error_of([&] { read_stations(write("s.csv", text)); });
  }
  std::string error_of_bearings(const std::string& text) const {
    const auto stations = read_stations(write("s.csv", std::string(kStations) + "a,1,2,3\n"));
    return error_of([&] { read_bearings(write("b.csv", text), stations); });
  }
};

TEST_F(CsvFilesTest, ReadsStations) {
  const auto stations = read_stations(
      write("s.csv", std::string(kStations) + "north,49.199461378,16.600180669,233.0887\n"
                                              "\"a b\",-1,-179,-5e0\n"));
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_EQ(stations[0].station, "north");
  EXPECT_EQ(stations[0].latitude_deg, 49.199461378);
  EXPECT_EQ(stations[0].longitude_deg, 16.600180669);
  EXPECT_EQ(stations[0].height_m, 233.0887);
  EXPECT_FALSE(stations[0].position_sd_m);
  EXPECT_EQ(stations[1].station, "a b");
  EXPECT_EQ(stations[1].height_m, -5.0);
}

// Columns in any order, strange ones beside them, optional ones given or left empty, a byte order
// mark, line ends of another system, empty lines, no line end at the end.
TEST_F(CsvFilesTest, FindsColumnsByName) {
  const auto stations = read_stations(
      write("s.csv",
            "\xEF\xBB\xBFheight_m,note,station,pointing_sd_deg,longitude_deg,latitude_deg,"
            "position_sd_m\r\n10,x, a ,0.5,20,30,\r\n\r\n11,y,b,,21,31,0.25"));
  ASSERT_EQ(stations.size(), 2U);
  EXPECT_EQ(stations[0].station, "a");
  EXPECT_EQ(stations[0].latitude_deg, 30.0);
  EXPECT_EQ(stations[0].longitude_deg, 20.0);
  EXPECT_EQ(stations[0].pointing_sd_deg, 0.5);
  EXPECT_FALSE(stations[0].position_sd_m);
  EXPECT_EQ(stations[1].position_sd_m, 0.25);
  EXPECT_FALSE(stations[1].pointing_sd_deg);
}

TEST_F(CsvFilesTest, ReadsBearingsExactly) {
  const auto stations = read_stations(write("s.csv", std::string(kStations) + "a,1,2,3\n"));
  const auto bearings =
      read_bearings(write("b.csv",
                          "utime_us,station,azimuth_deg,elevation_deg,sigma_deg,belief,target\n"
                          "1600000018965925,a,239.154728,1.666608,0.025952,0.75,drone\n"
                          "1600000018965926,a,-12,0,1,,\n"),
                    stations);
  ASSERT_EQ(bearings.size(), 2U);
  EXPECT_EQ(bearings[0].utime_us, 1600000018965925);
  EXPECT_EQ(bearings[0].azimuth_deg, 239.154728);
  EXPECT_EQ(bearings[0].sigma_deg, 0.025952);
  EXPECT_EQ(bearings[0].belief, 0.75);
  EXPECT_EQ(bearings[0].target, "drone");
  EXPECT_EQ(bearings[1].belief, 1.0);
  EXPECT_EQ(bearings[1].target, "1");
  const auto anonymous = read_bearings(
      write("n.csv",
            "utime_us,station,azimuth_deg,elevation_deg,sigma_deg\n1600000018965925,a,0,0,1"),
      stations);
  ASSERT_EQ(anonymous.size(), 1U);
  EXPECT_EQ(anonymous[0].target, "");
}

TEST_F(CsvFilesTest, NamesTheBadStation) {
  const std::string head = kStations;
  EXPECT_EQ(error_of_stations(""), "s.csv:1: header: is missing");
  EXPECT_EQ(error_of_stations("station,latitude_deg,height_m\na,1,2\n"),
            "s.csv:1: longitude_deg: the column is missing");
  EXPECT_EQ(error_of_stations(head), "s.csv:2: row: the file has a header but no rows");
  EXPECT_EQ(error_of_stations(head + "a,1,2,3\nb,91,2,3\n"),
            "s.csv:3: latitude_deg: 91 is outside -90 .. 90");
  EXPECT_EQ(error_of_stations(head + "a,1,2,3\n\nb,1,2,3m\n"),
            "s.csv:4: height_m: '3m' is not a number");
  EXPECT_EQ(error_of_stations(head + "a,nan,2,3\n"),
            "s.csv:2: latitude_deg: nan is outside -90 .. 90");
  EXPECT_EQ(error_of_stations(head + "a,1,inf,3\n"),
            "s.csv:2: longitude_deg: inf is outside -180 .. 360");
  EXPECT_EQ(error_of_stations(head + "a,,2,3\n"), "s.csv:2: latitude_deg: is empty");
  EXPECT_EQ(error_of_stations(head + ",1,2,3\n"), "s.csv:2: station: is empty");
  for (const char* id : {"\"a,b\"", "\"a\"\"b\"", "a\tb", "a\x1b[0m", "a\x7f"}) {
    EXPECT_EQ(error_of_stations(head + "b,1,2,3\n" + id + ",1,2,3\n"),
              "s.csv:3: station: has a comma, a quote or a control character")
        << id;
  }
  EXPECT_EQ(error_of_stations(head + "a,1,2,3\na,1,2,3\n"), "s.csv:3: station: 'a' appears twice");
  for (const char* row : {"a,1,2\n", "a,1,2,3,4\n", "\"a,1,2,3\n"}) {
    EXPECT_EQ(error_of_stations(head + row),
              "s.csv:2: row: too few or too many columns, or a quote that stays open")
        << row;
  }
  EXPECT_NE(error_of_stations("station,station,latitude_deg,longitude_deg,height_m\n"), "none");
  EXPECT_THROW(read_stations(folder_ / "absent.csv"), CsvError);
  EXPECT_THROW(read_stations(folder_), CsvError);
}

// As a loss of power leaves them, or a file in UTF-16: a row that begins with one seemed empty.
TEST_F(CsvFilesTest, NamesAZeroByte) {
  const std::string good = std::string(kStations) + "a,1,2,3\n", zeros(4, '\0');
  for (const std::string& end : {zeros, zeros + "\n", zeros + "b,1,2,3\n", "b,1,2" + zeros}) {
    EXPECT_EQ(error_of_stations(good + end),
              "s.csv:3: row: has a zero byte: the file is damaged, or no CSV in UTF-8");
  }
}

TEST_F(CsvFilesTest, NamesTheBadBearing) {
  const std::string head = kBearings;
  EXPECT_EQ(error_of_bearings(head + "1600000000000000,a,0,0,1\n"), "none");
  EXPECT_EQ(error_of_bearings(head + "1600000000000000,a,0,0,1\n1.5,a,0,0,1\n"),
            "b.csv:3: utime_us: '1.5' is not a number");
  EXPECT_EQ(error_of_bearings(head + "99999999999999999999,a,0,0,1\n"),
            "b.csv:2: utime_us: '99999999999999999999' is not a number");
  EXPECT_EQ(error_of_bearings(head + "-5,a,0,0,1\n"),
            "b.csv:2: utime_us: -5 is outside 0 .. 9000000000000000");
  EXPECT_EQ(error_of_bearings(head + "5,a,0,0,1\n"),
            "b.csv:2: utime_us: 5 is before 1980: microseconds since 1970 (UTC) are needed");
  EXPECT_TRUE(error_of_bearings(head + "1600000000,a,0,0,1\n").ends_with("seem to be seconds"));
  EXPECT_TRUE(
      error_of_bearings(head + "1600000000000,a,0,0,1\n").ends_with("seem to be milliseconds"));
  EXPECT_EQ(error_of_bearings(head + "1600000000000000,b,0,0,1\n"),
            "b.csv:2: station: 'b' is not one of the stations");
  EXPECT_EQ(error_of_bearings(head + "1600000000000000,a,361,0,1\n"),
            "b.csv:2: azimuth_deg: 361 is outside -360 .. 360");
  EXPECT_EQ(error_of_bearings(head + "1600000000000000,a,0,90.1,1\n"),
            "b.csv:2: elevation_deg: 90.1 is outside -90 .. 90");
  EXPECT_EQ(error_of_bearings(head + "1600000000000000,a,0,0,0\n"),
            "b.csv:2: sigma_deg: 0 is outside 1e-07 .. 90");
  EXPECT_EQ(error_of_bearings(head), "b.csv:2: row: the file has a header but no rows");
  EXPECT_EQ(error_of_bearings(head + "1600000000000000,\"a,b\",0,0,1\n"),
            "b.csv:2: station: has a comma, a quote or a control character");
  const std::string with_target = head.substr(0, head.size() - 1) + ",target\n";
  for (const char* id : {"\"a,b\"", "\"a\"\"b\"", "a\tb", "a\rb"}) {
    EXPECT_EQ(error_of_bearings(with_target + "1600000000000000,a,0,0,1," + id + "\n"),
              "b.csv:2: target: has a comma, a quote or a control character")
        << id;
  }
}

TEST_F(CsvFilesTest, NamesTheBadRowOfAFlight) {
  const auto error_of = [this](const std::string& text) {
    return CsvFilesTest::error_of([&] { read_flight(write("f.csv", text)); });
  };
  const std::string head = "utime_us,lat,lon,h\n1,49,16,350\n";
  EXPECT_EQ(error_of(head + "2,49,16,350\n"), "none");
  EXPECT_EQ(error_of("time,lat\n"), "f.csv:1: utime_us: the column is missing");
  EXPECT_EQ(error_of(head + "2,49,16\n"),
            "f.csv:3: row: too few or too many columns, or a quote that stays open");
  EXPECT_EQ(error_of(head + "2,49,16,nan\n"), "f.csv:3: h: nan is outside -10000 .. 100000");
  EXPECT_EQ(error_of(head + "1,49,16,350\n"),
            "f.csv:3: utime_us: is not later than in the row before");
  EXPECT_EQ(error_of(head + "2,149,16,350\n"), "f.csv:3: lat: 149 is outside -90 .. 90");
  EXPECT_EQ(error_of(head), "f.csv: at least two rows are needed");
}

// Otherwise the library looks for the line's end in what the buffer held before.
TEST_F(CsvFilesTest, EndsTheLastLineInTheReadThatReachesTheFilesEnd) {
  csv::EndedLines short_file(write("open.csv", "a,b"));
  std::string buffer(8, 'x');
  EXPECT_EQ(short_file.read(buffer.data(), 8), 4);
  EXPECT_EQ(buffer, "a,b\nxxxx");
  EXPECT_EQ(short_file.read(buffer.data(), 8), 0);
  csv::EndedLines full(write("full.csv", "a,b"));
  EXPECT_EQ(full.read(buffer.data(), 3), 3);
  EXPECT_EQ(full.read(buffer.data(), 3), 1);
  EXPECT_EQ(buffer[0], '\n');
}

TEST_F(CsvFilesTest, NamesAnotherSeparator) {
  std::string header = kStations;
  std::ranges::replace(header, ',', ';');
  EXPECT_EQ(error_of_stations(header + "a;1;2;3\n"),
            "s.csv:1: header: columns are separated by semicolons, commas are needed");
  std::ranges::replace(header, ';', '\t');
  EXPECT_EQ(error_of_stations(header + "a\t1\t2\t3\n"),
            "s.csv:1: header: columns are separated by tabs, commas are needed");
}

TEST_F(CsvFilesTest, ReadsASurveyOfBothForms) {
  const auto points = read_survey(write("p.csv",
                                        "landmark,height_m,sd_m,latitude_deg,longitude_deg,zone,"
                                        "easting_m,northing_m\n"
                                        "tower,310.5,0.14,49.2,16.6,,,\n"
                                        "mast,300,0,,,33S,616800.25,5450000\n"));
  ASSERT_EQ(points.size(), 2U);
  const auto& tower = std::get<GeodeticCells>(points[0].place);
  EXPECT_EQ(tower.latitude_deg, 49.2);
  EXPECT_EQ(tower.longitude_deg, 16.6);
  EXPECT_EQ(points[0].height_m, 310.5);
  EXPECT_EQ(points[0].sd_m, 0.14);
  const auto& mast = std::get<UtmCells>(points[1].place);
  EXPECT_EQ(mast.zone, 33);
  EXPECT_FALSE(mast.northern);
  EXPECT_EQ(mast.easting_m, 616800.25);
  EXPECT_EQ(mast.northing_m, 5450000.0);
  EXPECT_EQ(points[1].line, 3U);
  const auto sighted = read_sighted(
      write("s.csv", "landmark,pan_deg,tilt_deg,x_px,y_px\nmast,-12.5,3,,\ntower,1,2,640,480\n"),
      points);
  ASSERT_EQ(sighted.size(), 2U);
  EXPECT_EQ(sighted[0].pan_deg, -12.5);
  EXPECT_FALSE(sighted[0].x_px || sighted[0].y_px);
  EXPECT_EQ(sighted[1].y_px, 480.0);
}

}  // namespace
}  // namespace ols
