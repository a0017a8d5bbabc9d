#include "edge/calibration/covariance_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <vector>

#include "base/files/csv_files.h"
#include "tests/unit/edge/calibration/calibration_files.h"
#include "tests/unit/error_text.h"

namespace ols::calibration {
namespace {

TEST(CovarianceFile, OfTheInstrumentIsTheFirstPartOfTheStations) {
  const station::test::CalibrationFolder files("covariance_file");
  const StationMatrix all = read_station_covariance(files.path + "/covariance.csv");
  const InstrumentMatrix part = read_covariance(files.path + "/covariance.csv");
  EXPECT_EQ((all.topLeftCorner<kInstrumentParameters, kInstrumentParameters>()), part);
  EXPECT_NEAR(to_file(kHeading, to_file(kHeading, all(kHeading, kHeading))), 1e-8 * (kHeading + 1),
              1e-16);
}

// Files from before k3 and k4 were adjusted have neither.
TEST(CovarianceFile, AnOlderFileKnowsK3AndK4Exactly) {
  const station::test::CalibrationFolder files("covariance_file_older");
  const StationMatrix all = read_station_covariance(files.path + "/covariance.csv");
  std::istringstream text(station::test::covariance_text(1e-8));
  std::string older;
  int row = -1;
  for (std::string line; std::getline(text, line); ++row) {
    if (row == kK3 || row == kK4) continue;
    std::istringstream cells(line);
    int column = -1;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (column != kK3 && column != kK4) older += (column < 0 ? "" : ",") + cell;
    }
    older += "\n";
  }
  files.put("covariance.csv", older);
  StationMatrix expected = all;
  for (const int k : {kK3, kK4}) {
    expected.row(k).setZero();
    expected.col(k).setZero();
  }
  EXPECT_EQ(read_station_covariance(files.path + "/covariance.csv"), expected);
}

using Lines = std::vector<std::string>;

// Of the covariances across the diagonal, which are 0, one.
void set_covariance(Lines& lines, int row, int column, const std::string& value) {
  auto at = lines[static_cast<std::size_t>(row) + 1].begin();
  for (int i = 0; i <= column; ++i) at = std::find(at, lines[row + 1].end(), ',') + 1;
  lines[row + 1].replace(at, at + 1, value);
}

TEST(CovarianceFile, AMatrixThatIsNoneIsNamed) {
  const station::test::CalibrationFolder files("covariance_file_bad");
  const auto refusal = [&](const std::function<void(Lines&)>& spoil) {
    Lines lines;
    std::istringstream text(station::test::covariance_text(1e-8));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    spoil(lines);
    std::string spoilt;
    for (const std::string& line : lines) spoilt += line + "\n";
    files.put("covariance.csv", spoilt);
    return error_text<CsvError>([&] { read_station_covariance(files.path + "/covariance.csv"); });
  };
  const auto variance = [](Lines& lines, const std::string& value) {
    lines[1].replace(lines[1].find("1e-08"), 5, value);
  };
  using testing::HasSubstr;
  EXPECT_EQ(refusal([](Lines&) {}), "");
  EXPECT_THAT(refusal([](Lines& l) { l = {"", ""}; }), HasSubstr(":1: header: is missing"));
  EXPECT_THAT(refusal([](Lines& l) { l[0].replace(l[0].find("focal_px"), 8, "other_px"); }),
              HasSubstr(":1: focal_px: the column is missing"));
  EXPECT_THAT(refusal([](Lines& l) { l.erase(l.begin() + 1); }),
              HasSubstr("focal_px: the row is missing"));
  EXPECT_THAT(refusal([](Lines& l) { l.push_back(l[1]); }),
              HasSubstr("focal_px: the row appears twice"));
  EXPECT_THAT(refusal([](Lines& l) { l.push_back("aspect,1"); }),
              HasSubstr("row: too few or too many columns"));
  EXPECT_THAT(refusal([&](Lines& l) { variance(l, "1.5abc"); }),
              HasSubstr("focal_px: '1.5abc' is not a number"));
  EXPECT_THAT(refusal([&](Lines& l) { variance(l, "-1"); }),
              HasSubstr(":2: focal_px: the variance is negative"));
  EXPECT_THAT(refusal([](Lines& l) { set_covariance(l, 0, 1, "1e-3"); }),
              HasSubstr("is not symmetric"));
  const auto both = [](Lines& l, const std::string& value) {
    set_covariance(l, 0, 1, value);
    set_covariance(l, 1, 0, value);
  };
  EXPECT_THAT(refusal([&](Lines& l) { both(l, "1"); }),
              HasSubstr(":1: header: the matrix is not positive definite"));
  EXPECT_THAT(refusal([&](Lines& l) { both(l, "1e-9"), variance(l, "0"); }),
              HasSubstr("the variance is 0, and its covariances are not"));
}

}  // namespace
}  // namespace ols::calibration
