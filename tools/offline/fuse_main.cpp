// ols-fuse: positions from recorded bearings.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>
#include <utility>

#include "base/command_line.h"
#include "base/csv_files.h"
#include "central/offline/offline_fusion.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace {

const std::map<std::string, ols::PaperPairs> kPaperPairs = {
    {"algorithm-1", ols::PaperPairs::kAlgorithm1},
    {"centroid", ols::PaperPairs::kCentroid},
    {"best-baseline", ols::PaperPairs::kBestBaseline}};

struct Options {
  std::string stations;
  std::string bearings;
  std::string output;
  std::string estimator = "filter";
  bool smooth = false;
  double rate_hz = 0.0;
  std::optional<double> clock_sd_s;  // nothing: guessed
  ols::PaperConfig paper{};
  std::string paper_pairs = "algorithm-1";
  bool paper_halves = false;
};

ols::Sighting sighting_of(const ols::BearingRow& bearing, const ols::StationRow& station) {
  ols::Sighting sighting;
  sighting.station = bearing.station;
  sighting.utime_us = bearing.utime_us;
  sighting.belief = bearing.belief;
  ols::SightLine& sight = sighting.sight;
  sight.origin_ecef = ols::ecef_from_geodetic(
      {ols::radians(station.latitude_deg), ols::radians(station.longitude_deg), station.height_m});
  sight.direction = {ols::wrap_two_pi(ols::radians(bearing.azimuth_deg)),
                     ols::radians(bearing.elevation_deg)};
  const double sigma_rad = ols::radians(bearing.sigma_deg);
  const double pointing_rad = ols::radians(station.pointing_sd_deg.value_or(0.0));
  sight.covariance_white = Eigen::Matrix2d::Identity() * (sigma_rad * sigma_rad);
  sight.covariance_systematic = Eigen::Matrix2d::Identity() * (pointing_rad * pointing_rad);
  sight.origin_sd_enu_m.setConstant(station.position_sd_m.value_or(0.0));
  return sighting;
}

// By target id.
std::map<std::string, std::vector<ols::Sighting>> read_sightings(const Options& options) {
  const auto stations = ols::read_stations(options.stations);
  std::map<std::string, ols::StationRow> by_id;
  for (const auto& station : stations) by_id[station.station] = station;
  std::map<std::string, std::vector<ols::Sighting>> sightings;
  for (const auto& bearing : ols::read_bearings(options.bearings, stations)) {
    sightings[bearing.target].push_back(sighting_of(bearing, by_id.at(bearing.station)));
  }
  for (auto& [id, own] : sightings) {
    ols::guess_clocks(own);
    if (!options.clock_sd_s) continue;
    for (ols::Sighting& sighting : own) sighting.clock_sd_s = *options.clock_sd_s;
  }
  return sightings;
}

ols::FixRow fix_of(const ols::FusedTarget& target, const std::string& id) {
  const ols::Estimate& estimate = target.estimate;
  const ols::Geodetic place = ols::geodetic_from_ecef(estimate.position_ecef);
  const Eigen::Matrix3d R = ols::R_ecef_enu(place);
  const Eigen::Vector3d sd = (R.transpose() * estimate.covariance_ecef * R).diagonal().cwiseSqrt();
  const auto used = std::ranges::count_if(target.stations, &ols::ContributingStation::used);
  ols::FixRow fix;
  fix.utime_us = target.utime_us;
  fix.target = id;
  fix.latitude_deg = ols::degrees(place.latitude_rad);
  fix.longitude_deg = ols::degrees(place.longitude_rad);
  fix.height_m = place.height_m;
  fix.east_sd_m = sd.x();
  fix.north_sd_m = sd.y();
  fix.up_sd_m = sd.z();
  fix.stations_used = static_cast<int>(used);
  fix.stations_set_aside = static_cast<int>(target.stations.size()) - fix.stations_used;
  fix.crossing_angle_deg = ols::degrees(estimate.crossing_angle_rad);
  fix.residual = estimate.residual;
  return fix;
}

void tell_unused(const ols::UnusedBearings& unused, std::size_t bearings) {
  const std::size_t all = unused.low_belief + unused.duplicate;
  if (all == 0) return;
  std::cerr << "ols-fuse: " << all << " of " << bearings << " bearings not used:";
  const char* separator = " ";
  for (const auto& [count, why] :
       {std::pair(unused.low_belief, "of low belief"),
        std::pair(unused.duplicate, "a station and time given before")}) {
    if (count == 0) continue;
    std::cerr << separator << count << ' ' << why;
    separator = ", ";
  }
  std::cerr << '\n';
}

// The states in which there is no position, and at how many of the instants.
void tell_unlocated(const ols::Unlocated& unlocated, std::size_t fixes, const std::string& id) {
  if (unlocated.empty()) return;
  std::size_t instants = fixes;
  for (const auto& [solution, count] : unlocated) instants += count;
  std::cerr << "ols-fuse: target " << id << ": no position at";
  const char* separator = " ";
  for (const auto& [solution, count] : unlocated) {
    std::cerr << separator << count << " of " << instants << " instants ("
              << ols::to_string(solution) << ')';
    separator = ", ";
  }
  std::cerr << '\n';
}

void run(const Options& options) {
  ols::OfflineConfig config;
  config.estimator = options.estimator;
  config.smooth = options.smooth;
  config.rate_hz = options.rate_hz;
  config.fusion.estimators.paper = options.paper;
  config.fusion.estimators.paper.pairs = kPaperPairs.at(options.paper_pairs);
  config.fusion.estimators.paper.by_belief = !options.paper_halves;
  std::vector<ols::FixRow> fixes;
  ols::UnusedBearings unused;
  std::size_t bearings = 0;
  for (const auto& [id, sightings] : read_sightings(options)) {
    bearings += sightings.size();
    const ols::UnusedBearings here = ols::unused_bearings(sightings, config);
    unused.low_belief += here.low_belief;
    unused.duplicate += here.duplicate;
    for (const auto& [station, why] : ols::stations_beside(sightings, config)) {
      std::cerr << "ols-fuse: station " << station << ", target " << id << ": " << why << '\n';
    }
    ols::Unlocated unlocated;
    const auto targets = ols::fuse_offline(sightings, config, &unlocated);
    for (const auto& target : targets) fixes.push_back(fix_of(target, id));
    tell_unlocated(unlocated, targets.size(), id);
  }
  std::ranges::stable_sort(fixes, {}, &ols::FixRow::utime_us);
  ols::write_fixes(options.output, fixes);
  tell_unused(unused, bearings);
}

void add_files(CLI::App& app, Options& options) {
  app.add_option("--stations", options.stations,
                 "CSV: station,latitude_deg,longitude_deg,height_m[,position_sd_m,pointing_sd_deg]")
      ->required();
  app.add_option("--bearings", options.bearings,
                 "CSV: utime_us,station,azimuth_deg,elevation_deg,sigma_deg[,belief,target]")
      ->required();
  app.add_option("--output", options.output,
                 "CSV: utime_us,target,latitude_deg,longitude_deg,height_m,east_sd_m,north_sd_m,"
                 "up_sd_m,...")
      ->required();
}

void add_choices(CLI::App& app, Options& options) {
  app.add_option("--estimator", options.estimator,
                 "filter (over time), least-squares (all rays of an instant) or paper")
      ->check(CLI::IsMember({"filter", "least-squares", "paper"}))
      ->capture_default_str();
  app.add_flag("--smooth", options.smooth,
               "with the filter: use the bearings after each instant too");
  app.add_option("--paper-pairs", options.paper_pairs,
                 "with paper: pairs of stations, by algorithm-1, centroid (unweighted) or "
                 "best-baseline (section 4.1)")
      ->check(CLI::IsMember(kPaperPairs))
      ->capture_default_str();
  app.add_flag("--paper-halves", options.paper_halves,
               "with paper: turn both views by half of the angle, whatever their beliefs");
  app.add_option("--rate", options.rate_hz,
                 "[Hz] fixes on an even grid in time; 0: at the instant of every bearing")
      ->check(CLI::Range(0.0, 10000.0))
      ->capture_default_str();
  app.add_option("--clock-sd", options.clock_sd_s,
                 "[s] 1-sigma of each station's clock, which the files do not tell; guessed from "
                 "noise and angular speed unless given")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--moving-average", options.paper.moving_average,
                 "[fixes] with paper: mean of the last so many; 1: none")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Positions (WGS84, metres above the ellipsoid, 1-sigma) from recorded bearings."};
  Options options;
  add_files(app, options);
  add_choices(app, options);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-fuse")) return *status;
  try {
    run(options);
  } catch (const std::exception& error) {
    std::cerr << "ols-fuse: " << error.what() << '\n';
    return ols::kExitBadInput;
  }
  return 0;
}
