#include "edge/calibration/covariance_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/files/csv_files.h"
#include "tests/unit/edge/calibration/calibration_files.h"

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

TEST(CovarianceFile, AMatrixThatIsNoneIsNamed) {
  const station::test::CalibrationFolder files("covariance_file_bad");
  std::string text = station::test::covariance_text(1e-8);
  text.replace(text.find("1e-08,"), 5, "-1e-8");
  files.put("covariance.csv", text);
  EXPECT_THAT([&] { read_station_covariance(files.path + "/covariance.csv"); },
              testing::ThrowsMessage<CsvError>(
                  testing::HasSubstr(":2: focal_px: the variance is negative")));
}

}  // namespace
}  // namespace ols::calibration
