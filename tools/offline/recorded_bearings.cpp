#include "tools/offline/recorded_bearings.h"

#include <algorithm>
#include <cmath>

#include "base/csv_files.h"
#include "central/offline/offline_fusion.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::offline {
namespace {

constexpr double kDegree_rad = kPi / 180.0;

// `unit_rad` is the unit of the row's angles, one degree unless radians were exported.
fusion::BearingMeasurement sighting_of(const BearingRow& bearing, const StationRow& station,
                                       double unit_rad) {
  fusion::BearingMeasurement sighting;
  sighting.station = bearing.station;
  sighting.utime_us = bearing.utime_us;
  sighting.belief = bearing.belief;
  LineOfSight& sight = sighting.sight;
  sight.origin_ecef = ecef_from_geodetic(
      {radians(station.latitude_deg), radians(station.longitude_deg), station.height_m});
  sight.direction = {wrap_two_pi(bearing.azimuth_deg * unit_rad), bearing.elevation_deg * unit_rad};
  const double sigma_rad = bearing.sigma_deg * unit_rad;
  const double pointing_rad = radians(station.pointing_sd_deg.value_or(0.0));
  sight.covariance_white = Eigen::Matrix2d::Identity() * (sigma_rad * sigma_rad);
  sight.covariance_systematic = Eigen::Matrix2d::Identity() * (pointing_rad * pointing_rad);
  sight.origin_sd_enu_m.setConstant(station.position_sd_m.value_or(0.0));
  return sighting;
}

RecordedBearings recorded(const std::vector<StationRow>& stations,
                          const std::vector<BearingRow>& bearings, double unit_rad) {
  std::map<std::string, StationRow> by_id;
  for (const StationRow& station : stations) by_id[station.station] = station;
  RecordedBearings recording;
  for (const BearingRow& bearing : bearings) {
    recording[bearing.target].push_back(sighting_of(bearing, by_id.at(bearing.station), unit_rad));
  }
  for (auto& [id, own] : recording) fusion::guess_clocks(own);
  return recording;
}

std::size_t instants_with_position(const RecordedBearings& recording) {
  std::size_t count = 0;
  for (const auto& [id, sightings] : recording) count += fusion::fuse_offline(sightings, {}).size();
  return count;
}

// Radians read as degrees form a bundle of a few degrees about north, which may meet by chance.
// Small angles prove nothing: the unit in which more lines of sight meet decides.
void require_degrees(const std::string& path, const std::vector<StationRow>& stations,
                     const std::vector<BearingRow>& bearings, const RecordedBearings& as_degrees) {
  const bool can_be_radians = std::ranges::all_of(bearings, [](const BearingRow& row) {
    return std::abs(row.azimuth_deg) <= 2.0 * kPi && std::abs(row.elevation_deg) <= kPi / 2.0;
  });
  if (!can_be_radians) return;
  constexpr std::size_t kClearly = 2;
  const std::size_t by_degrees = instants_with_position(as_degrees);
  const std::size_t by_radians = instants_with_position(recorded(stations, bearings, 1.0));
  if (by_radians <= kClearly * by_degrees) return;
  throw CsvError(path +
                 ": azimuth_deg, elevation_deg: these seem to be radians: as such the lines "
                 "of sight meet at " +
                 std::to_string(by_radians) + " instants, as degrees at " +
                 std::to_string(by_degrees));
}

}  // namespace

RecordedBearings read_recorded_bearings(const std::string& stations_path,
                                        const std::string& bearings_path) {
  const auto stations = read_stations(stations_path);
  const auto bearings = read_bearings(bearings_path, stations);
  RecordedBearings recording = recorded(stations, bearings, kDegree_rad);
  require_degrees(bearings_path, stations, bearings, recording);
  return recording;
}

}  // namespace ols::offline
