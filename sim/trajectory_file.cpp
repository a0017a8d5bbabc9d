#include "sim/trajectory_file.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "base/toml_config.h"
#include "geometry/angles.h"

namespace ols::sim {
namespace {

constexpr std::string_view kHeader = "utime_us,lat,lon,h";

ConfigError row_error(const std::string& name, int line, const std::string& what) {
  return ConfigError(name + ":" + std::to_string(line) + ": " + what);
}

// The next number of the row, which is taken off together with its comma.
bool take(std::string_view& row, double& value, bool last) {
  const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  row.remove_prefix(static_cast<std::size_t>(end - row.data()));
  if (last) return row.empty();
  if (!row.starts_with(',')) return false;
  row.remove_prefix(1);
  return true;
}

}  // namespace

std::unique_ptr<Trajectory> read_trajectory_file(std::istream& in, const std::string& name,
                                                 const LocalFrame& site) {
  std::string text;
  if (!std::getline(in, text) || text != kHeader) {
    throw row_error(name, 1, "the header must be " + std::string(kHeader));
  }
  std::vector<double> utimes_us, times_s;
  std::vector<Eigen::Vector3d> points;
  for (int line = 2; std::getline(in, text); ++line) {
    std::string_view row = text;
    double utime_us = 0, lat_deg = 0, lon_deg = 0, height_m = 0;
    if (!take(row, utime_us, false) || !take(row, lat_deg, false) || !take(row, lon_deg, false) ||
        !take(row, height_m, true)) {
      throw row_error(name, line, "four numbers expected");
    }
    if (std::abs(lat_deg) > 90 || std::abs(lon_deg) > 360) {
      throw row_error(name, line, "lat or lon out of range");
    }
    if (!utimes_us.empty() && utime_us <= utimes_us.back()) {
      throw row_error(name, line, "utime_us must grow");
    }
    utimes_us.push_back(utime_us);
    times_s.push_back(1e-6 * (utime_us - utimes_us.front()));
    points.push_back(
        site.to_enu(ecef_from_geodetic({radians(lat_deg), radians(lon_deg), height_m})));
  }
  if (points.size() < 2) throw row_error(name, 2, "at least two rows expected");
  return std::make_unique<Spline>(std::move(times_s), std::move(points));
}

std::unique_ptr<Trajectory> load_trajectory_file(const std::string& path, const LocalFrame& site) {
  std::ifstream in(path);
  if (!in) throw ConfigError(path + ": cannot be read");
  return read_trajectory_file(in, path, site);
}

}  // namespace ols::sim
