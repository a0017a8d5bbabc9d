#include "tools/calibrate/calibration_csv.h"

#include <map>

#include "base/files/csv_rows.h"

namespace ols {
namespace {

using csv::for_each_row;
using csv::Header;
using csv::Row;

constexpr std::size_t kReferenceColumns = 14, kPredictColumns = 8;
constexpr Header<kReferenceColumns> kReferences{
    {"landmark", "height_m", "sd_m", "latitude_deg", "longitude_deg", "zone", "easting_m",
     "northing_m", "utime_us", "ra_deg", "dec_deg", "pm_ra_mas_yr", "pm_dec_mas_yr",
     "parallax_mas"},
    1};
constexpr Header<kPredictColumns> kPredictions{
    {"pan_counts", "tilt_counts", "x_px", "y_px", "approach_pan", "approach_tilt", "utime_us",
     "station"},
    4};
constexpr std::int64_t kGreatestUtime = 9'000'000'000'000'000;

StarCells star_cells(const Row<kReferenceColumns>& row) {
  StarCells star;
  star.ra_deg = row.number<double>(9, 0.0, 360.0);
  star.dec_deg = row.number<double>(10, -90.0, 90.0);
  star.pm_ra_mas_yr = row.optional_number(11, -2e4, 2e4).value_or(0.0);
  star.pm_dec_mas_yr = row.optional_number(12, -2e4, 2e4).value_or(0.0);
  star.parallax_mas = row.optional_number(13, -1e3, 1e3).value_or(0.0);
  return star;
}

ReferenceRow reference_row(const Row<kReferenceColumns>& row) {
  ReferenceRow one;
  one.name = row.id(0);
  one.line = row.line();
  if (row.has(9) || row.has(10)) {
    one.star = star_cells(row);
    return one;
  }
  one.height_m = row.number<double>(1, -1e3, 100e3);
  one.sd_m = row.number<double>(2, 0.0, 1e4);
  one.place = csv::place_of(row, 3, 5);
  if (row.has(8)) one.utime_us = row.number<std::int64_t>(8, 0, kGreatestUtime);
  return one;
}

int approach_of(const Row<kPredictColumns>& row, std::size_t column) {
  if (!row.has(column)) return 1;
  const int approach = row.number<int>(column, -1, 1);
  if (approach == 0) row.fail(column, "must be 1 or -1");
  return approach;
}

}  // namespace

std::vector<ReferenceRow> read_references(const std::string& path) {
  std::vector<ReferenceRow> rows;
  std::map<std::string, std::optional<std::int64_t>> last;  // of each name, its newest time
  for_each_row(path, kReferences, [&](const Row<kReferenceColumns>& row) {
    rows.push_back(reference_row(row));
    const ReferenceRow& one = rows.back();
    const auto [before, is_new] = last.try_emplace(one.name, one.utime_us);
    if (is_new) return;
    if (!before->second || !one.utime_us) row.fail(0, "'" + one.name + "' appears twice");
    if (*one.utime_us <= *before->second) row.fail(8, "is not later than in the row before");
    before->second = one.utime_us;
  });
  if (rows.empty()) throw CsvError(path + ":2: row: the file has a header but no rows");
  return rows;
}

std::vector<PredictRow> read_predictions(const std::string& path) {
  std::vector<PredictRow> rows;
  for_each_row(path, kPredictions, [&](const Row<kPredictColumns>& row) {
    PredictRow one;
    one.pan_counts = row.number<double>(0, -1e7, 1e7);
    one.tilt_counts = row.number<double>(1, -1e7, 1e7);
    one.x_px = row.number<double>(2, -1e5, 1e5);
    one.y_px = row.number<double>(3, -1e5, 1e5);
    one.approach_pan = approach_of(row, 4);
    one.approach_tilt = approach_of(row, 5);
    if (row.has(6)) one.utime_us = row.number<std::int64_t>(6, 0, kGreatestUtime);
    if (row.has(7)) one.station = row.id(7);
    one.line = row.line();
    rows.push_back(one);
  });
  if (rows.empty()) throw CsvError(path + ":2: row: the file has a header but no rows");
  return rows;
}

}  // namespace ols
