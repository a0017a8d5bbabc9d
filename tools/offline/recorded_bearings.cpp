#include "tools/offline/recorded_bearings.h"

#include <cmath>
#include <map>
#include <utility>

#include "base/files/csv_files.h"
#include "central/offline/offline_fusion.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tools/offline/near_place.h"

namespace ols::offline {
namespace {

constexpr double kDegree_rad = kPi / 180.0;
const std::string kOnlyTarget = "1";

// Each station's place, in a line of sight without a direction.
std::map<std::string, LineOfSight> places_of(const std::vector<StationRow>& stations) {
  std::map<std::string, LineOfSight> places;
  for (const StationRow& station : stations) {
    LineOfSight& sight = places[station.station];
    sight.origin_ecef = ecef_from_geodetic(
        {radians(station.latitude_deg), radians(station.longitude_deg), station.height_m});
    const double pointing_rad = radians(station.pointing_sd_deg.value_or(0.0));
    sight.covariance_systematic = Eigen::Matrix2d::Identity() * (pointing_rad * pointing_rad);
    sight.origin_sd_enu_m.setConstant(station.position_sd_m.value_or(0.0));
  }
  return places;
}

// A station that is far from all others cannot see what they see, so its place must be wrong.
void require_neighbours(const std::string& path, const std::vector<StationRow>& stations) {
  std::vector<Geodetic> places;
  for (const StationRow& s : stations)
    places.push_back({radians(s.latitude_deg), radians(s.longitude_deg), s.height_m});
  for (std::size_t i = 0; places.size() > 1 && i < places.size(); ++i) {
    std::vector<Geodetic> others = places;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    require_near(path + ": " + stations[i].station, places[i], others, "the other stations",
                 2.0 * kCameraRange_m);
  }
}

// `unit_rad` is the unit of the row's angles, one degree unless radians were exported.
fusion::BearingMeasurement sighting_of(const BearingRow& bearing, const LineOfSight& place,
                                       double unit_rad) {
  fusion::BearingMeasurement sighting;
  sighting.station = bearing.station;
  sighting.utime_us = bearing.utime_us;
  sighting.belief = bearing.belief;
  sighting.sight = place;
  sighting.sight.direction = {wrap_two_pi(bearing.azimuth_deg * unit_rad),
                              bearing.elevation_deg * unit_rad};
  const double sigma_rad = bearing.sigma_deg * unit_rad;
  sighting.sight.covariance_white = Eigen::Matrix2d::Identity() * (sigma_rad * sigma_rad);
  return sighting;
}

// Also tells whether all angles could be radians.
RecordedBearings recorded(const std::string& path, const std::vector<StationRow>& stations,
                          double unit_rad, bool& can_be_radians) {
  const std::map<std::string, LineOfSight> places = places_of(stations);
  RecordedBearings recording;
  std::map<std::string, std::uint32_t> numbers;
  can_be_radians = true;
  for_each_bearing(path, stations, [&](const BearingRow& row) {
    can_be_radians = can_be_radians && std::abs(row.azimuth_deg) <= 2.0 * kPi &&
                     std::abs(row.elevation_deg) <= kPi / 2.0;
    recording.bearings.push_back(sighting_of(row, places.at(row.station), unit_rad));
    if (row.target.empty()) return;
    const auto [number, is_new] =
        numbers.try_emplace(row.target, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) recording.targets.push_back(row.target);
    recording.target_of.push_back(number->second);
  });
  return recording;
}

// Changes the recording's clocks, which its user sets anyway: a copy would double the memory.
std::size_t instants_with_position(RecordedBearings& recording) {
  std::size_t count = 0;
  for (const RecordedTarget& target : targets_of(recording)) {
    fusion::guess_clocks(target.bearings);
    fusion::fuse_offline({target.bearings.begin(), target.bearings.end()}, {},
                         [&](const fusion::FusedTarget&) { ++count; });
  }
  return count;
}

// Radians read as degrees form a bundle of a few degrees about north, which may meet by chance.
// Small angles prove nothing: the unit in which more lines of sight meet decides.
void require_degrees(const std::string& path, const std::vector<StationRow>& stations,
                     RecordedBearings& as_degrees) {
  constexpr std::size_t kClearly = 2;
  bool can_be_radians = true;
  const std::size_t by_degrees = instants_with_position(as_degrees);
  RecordedBearings as_radians = recorded(path, stations, 1.0, can_be_radians);
  const std::size_t by_radians = instants_with_position(as_radians);
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
  require_neighbours(stations_path, stations);
  bool can_be_radians = true;
  RecordedBearings recording = recorded(bearings_path, stations, kDegree_rad, can_be_radians);
  if (can_be_radians) require_degrees(bearings_path, stations, recording);
  return recording;
}

std::vector<RecordedTarget> targets_of(RecordedBearings& recording) {
  std::map<std::string, fusion::MutableBearings> by_name;
  for (std::size_t i = 0; i < recording.bearings.size(); ++i) {
    const std::string& name =
        recording.targets.empty() ? kOnlyTarget : recording.targets[recording.target_of[i]];
    by_name[name].push_back(&recording.bearings[i]);
  }
  std::vector<RecordedTarget> targets;
  for (auto& [name, bearings] : by_name) targets.push_back({name, std::move(bearings)});
  return targets;
}

}  // namespace ols::offline
