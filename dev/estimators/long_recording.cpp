#include "dev/estimators/long_recording.h"

#include <cmath>
#include <iomanip>
#include <ostream>
#include <random>
#include <vector>

#include "base/files/atomic_file.h"
#include "dev/estimators/bearing_world.h"
#include "geometry/angles.h"
#include "geometry/direction.h"

namespace ols::bench {
namespace {

using Eigen::Vector3d;

constexpr double kRateHz = 25.0, kNoiseRad = 3e-4, kRadiusM = 300.0;

// Figures of eight, each target's at a height and with a phase of its own.
Vector3d place_of(int target, double t_s) {
  const double phase = 1.7 * target, w = 0.12;
  return {120.0 * std::sin(w * t_s + phase), 70.0 * std::sin(2.0 * w * t_s + phase),
          90.0 + 25.0 * target + 10.0 * std::sin(0.5 * w * t_s)};
}

void write_stations(const std::string& path, const std::vector<Vector3d>& places_ecef) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "station,latitude_deg,longitude_deg,height_m\n" << std::fixed << std::setprecision(9);
  for (std::size_t i = 0; i < places_ecef.size(); ++i) {
    const Geodetic place = geodetic_from_ecef(places_ecef[i]);
    out << 's' << i << ',' << degrees(place.latitude_rad) << ',' << degrees(place.longitude_rad)
        << ',' << place.height_m << '\n';
  }
  file.commit();
}

}  // namespace

void write_long_recording(const std::string& folder, const LongRecording& recording) {
  std::vector<Vector3d> places;
  for (const Vector3d& place : circle(recording.stations, kRadiusM))
    places.push_back(site().to_ecef(place));
  write_stations(folder + "/stations.csv", places);
  std::mt19937_64 random(19);
  std::normal_distribution<double> normal(0.0, kNoiseRad);
  AtomicFile file(folder + "/bearings.csv");
  std::ostream& out = file.stream();
  out << "utime_us,station,azimuth_deg,elevation_deg,sigma_deg"
      << (recording.are_named ? ",target\n" : "\n") << std::fixed << std::setprecision(6);
  const auto targets = static_cast<std::size_t>(recording.targets);
  for (std::size_t row = 0; row < recording.rows; ++row) {
    const std::size_t exposure = row / targets, station = exposure % places.size();
    const int target = static_cast<int>(row % targets);
    const auto after_us = std::llround(1e6 * static_cast<double>(exposure) /
                                       (kRateHz * static_cast<double>(places.size())));
    const Vector3d line =
        site().to_ecef(place_of(target, 1e-6 * static_cast<double>(after_us))) - places[station];
    const AzimuthElevation direction =
        azimuth_elevation_from_enu(R_ecef_enu(places[station]).transpose() * line);
    const double across = normal(random), up = normal(random);
    out << kStartUs + after_us << ",s" << station << ','
        << degrees(wrap_two_pi(direction.azimuth_rad + across / std::cos(direction.elevation_rad)))
        << ',' << degrees(direction.elevation_rad + up) << ',' << degrees(kNoiseRad);
    if (recording.are_named) out << ',' << target + 1;
    out << '\n';
  }
  file.commit();
}

}  // namespace ols::bench
