#include "tools/land/scenery_file.h"

#include <utility>

#include "base/files/atomic_file.h"
#include "base/files/csv_rows.h"
#include "conditions/printed.h"

namespace ols::land {
namespace {

enum Column : std::size_t {
  kStation,
  kOther,
  kLatitude,
  kLongitude,
  kHeight,
  kHeightSd,
  kAzimuth,
  kElevation,
  kRange,
  kRangeSd,
  kRangeSystematicSd,
  kColumns
};
constexpr csv::Header<kColumns> kHeader{
    {"station", "other", "latitude_deg", "longitude_deg", "height_m", "height_sd_m", "azimuth_deg",
     "elevation_deg", "range_m", "range_sd_m", "range_sd_systematic_m"},
    kColumns};

SceneryRow row_from(const csv::Row<kColumns>& row) {
  constexpr double kFarthest_m = 100e3;
  return {row.id(kStation),
          row.id(kOther),
          row.number<double>(kLatitude, -90.0, 90.0),
          row.number<double>(kLongitude, -180.0, 180.0),
          row.number<double>(kHeight, -500.0, 10'000.0),
          row.number<double>(kHeightSd, 0.0, 1000.0),
          row.number<double>(kAzimuth, 0.0, 360.0),
          row.number<double>(kElevation, -90.0, 90.0),
          row.number<double>(kRange, 1.0, kFarthest_m),
          row.number<double>(kRangeSd, 0.0, kFarthest_m),
          row.number<double>(kRangeSystematicSd, 0.0, kFarthest_m)};
}

}  // namespace

void write_scenery(const std::string& path, const std::vector<SceneryRow>& rows) {
  AtomicFile file(path);
  const char* separator = "";
  for (const char* name : kHeader.names) {
    file.stream() << std::exchange(separator, ",") << name;
  }
  for (const SceneryRow& row : rows) {
    file.stream() << '\n'
                  << row.station << ',' << row.other
                  << printed(",%.8f,%.8f,%.2f,%.2f,%.4f,%.4f,%.2f,%.2f,%.2f", row.latitude_deg,
                             row.longitude_deg, row.height_m, row.height_sd_m, row.azimuth_deg,
                             row.elevation_deg, row.range_m, row.range_sd_m,
                             row.range_sd_systematic_m);
  }
  file.stream() << '\n';
  file.commit();
}

std::vector<SceneryRow> read_scenery(const std::string& path) {
  std::vector<SceneryRow> rows;
  csv::for_each_row(path, kHeader,
                    [&](const csv::Row<kColumns>& row) { rows.push_back(row_from(row)); });
  if (rows.empty()) throw CsvError(path + ": has no rows");
  return rows;
}

}  // namespace ols::land
