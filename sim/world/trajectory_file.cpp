#include "sim/world/trajectory_file.h"

#include "base/config/toml_config.h"
#include "base/files/csv_files.h"
#include "geometry/angles.h"

namespace ols::sim {
namespace {

// A trajectory file is part of the scenario: its errors are configuration errors.
std::vector<FlightRow> rows_of(const std::string& path) {
  try {
    return read_flight(path);
  } catch (const CsvError& error) {
    throw ConfigError(error.what());
  }
}

}  // namespace

std::unique_ptr<Trajectory> load_trajectory_file(const std::string& path, const LocalFrame& site) {
  const std::vector<FlightRow> rows = rows_of(path);
  std::vector<double> times_s;
  std::vector<Eigen::Vector3d> points;
  for (const FlightRow& row : rows) {
    times_s.push_back(1e-6 * static_cast<double>(row.utime_us - rows.front().utime_us));
    points.push_back(site.to_enu(
        ecef_from_geodetic({radians(row.latitude_deg), radians(row.longitude_deg), row.height_m})));
  }
  return std::make_unique<Spline>(std::move(times_s), std::move(points));
}

}  // namespace ols::sim
