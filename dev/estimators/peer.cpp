#include "dev/estimators/peer.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "central/tracking/recorded_track.h"
#include "dev/bench/load.h"
#include "dev/estimators/bearing_world.h"
#include "tools/offline/timing_csv.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;

constexpr double kDurationS = 12.0, kDisturbance = 0.5;

std::ofstream opened(const std::string& folder, const char* name, const char* header) {
  const auto path = std::filesystem::path(folder) / name;
  std::ofstream file(path);
  file.precision(12);
  file << header << '\n';
  if (!file) throw std::runtime_error("cannot write " + path.string());
  return file;
}

void put(std::ostream& out, const Vector3d& v) {
  out << ',' << v.x() << ',' << v.y() << ',' << v.z();
}

// The filter of one object, as it runs on recordings, with what the other is given, too: the true
// motion, and no other model, and the noise, white and Gaussian as stated.
fusion::TrackManagerConfig pinned() {
  fusion::TrackManagerConfig config;
  config.filter.motion.models = {fusion::Motion::kConstantVelocity};
  config.filter.motion.cruise_sd_m_s2 = kDisturbance;
  config.filter.motion.cruise_per_speed_s = 0.0;
  config.filter.robust_nis = config.filter.gate_nis;
  config.errors.noise_weight = 1e9;
  config.errors.stated_weight = 1e9;
  config.errors.least_over_noise = 0.0;
  config.errors.colour_time_s = config.errors.undeclared_colour_time_s = 0.0;
  return config;
}

std::vector<std::optional<Vector3d>> our_fixes(
    const std::vector<fusion::BearingMeasurement>& bearings, std::vector<double>& cpu_us) {
  std::vector<std::optional<Vector3d>> fixes;
  fixes.reserve(bearings.size());
  const double before_s = offline::thread_time_s();
  fusion::RecordedTrack track(pinned());
  for (const fusion::BearingMeasurement& measurement : bearings) {
    track.add(measurement);
    const auto& tracks = track.tracks();
    const bool found = !tracks.empty() && fusion::is_established(tracks.front());
    fixes.push_back(found ? std::optional(tracks.front().filter.position()) : std::nullopt);
  }
  cpu_us.push_back(1e6 * (offline::thread_time_s() - before_s) /
                   static_cast<double>(bearings.size()));
  return fixes;
}

}  // namespace

void write_peer_runs(const std::string& folder, int runs) {
  std::filesystem::create_directories(folder);
  const WorldConfig world{.stations_enu = circle(4, 250.0), .bias_sd_rad = 1e-6};
  auto stations = opened(folder, "stations.csv", "station,east_m,north_m,up_m");
  for (std::size_t i = 0; i < world.stations_enu.size(); ++i) {
    stations << 's' << i;
    put(stations, world.stations_enu[i]);
    stations << '\n';
  }
  auto bearings_file =
      opened(folder, "bearings.csv", "run,time_s,station,azimuth_rad,elevation_rad");
  auto fixes_file = opened(folder, "fixes.csv",
                           "run,time_s,true_east_m,true_north_m,true_up_m,east_m,north_m,up_m");
  std::vector<double> cpu_us;  // a bearing, of each run
  for (int run = 0; run < runs; ++run) {
    std::mt19937_64 random(static_cast<std::uint64_t>(run) + 1);
    const Path path = cruising({{-60, 40, 80}, {9.0, -6.0, 1.0}}, kDisturbance, kDurationS, random);
    const auto bearings = measure(world, {path}, kDurationS, random);
    const auto fixes = our_fixes(bearings, cpu_us);
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      const double time_s = 1e-6 * static_cast<double>(bearings[i].utime_us - kStartUs);
      const AzimuthElevation d = azimuth_elevation_from_enu(site().R_ecef_enu().transpose() *
                                                            direction_ecef(bearings[i].sight));
      bearings_file << run << ',' << time_s << ',' << bearings[i].station << ',' << d.azimuth_rad
                    << ',' << d.elevation_rad << '\n';
      fixes_file << run << ',' << time_s;
      put(fixes_file, at(path, time_s).p_enu);
      if (fixes[i]) put(fixes_file, site().to_enu(*fixes[i]));
      fixes_file << (fixes[i] ? "\n" : ",,,\n");
    }
  }
  auto pinned_file = opened(folder, "pinned.csv", "noise_rad,disturbance,cpu_us");
  pinned_file << world.noise_rad << ',' << kDisturbance << ',' << quantile(cpu_us, 0.5) << '\n';
}

}  // namespace ols::bench
