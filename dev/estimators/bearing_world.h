// Simulated bearings without images: targets fly, and stations measure their directions with noise,
// biases, misses and false bearings. For Monte Carlo runs of the estimators. The same seed gives
// the same bearings.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "central/fusion/fusion.h"
#include "geometry/wgs84.h"

namespace ols::bench {

inline constexpr std::int64_t kStartUs = 1'700'000'000'000'000;

struct WorldConfig {
  std::vector<Eigen::Vector3d> stations_enu;  // [m]
  std::vector<Eigen::Vector3d> aims_enu =
      {};  // where the cameras point, for false bearings; empty: 80 m above the origin
  double rate_hz = 30.0;  // frame rate of each station; the stations' frames are evenly staggered
  double noise_rad = 3e-4;
  double bias_sd_rad = 0.0;     // 1-sigma of each station's bias, about east, north and up
  double heading_sd_rad = 0.0;  // 1-sigma of an additional rotation about up
  double bias_time_s = 1e12;    // correlation time of both; with the default they are constant
  // 1-sigma of the constant error of each station's stated position, in each of east, north, up.
  double place_sd_m = 0.0;
  bool bias_stated = true;       // whether the stations state these sigmas with their bearings
  double missed = 0.0;           // share of a station's detections that are missing
  double false_per_frame = 0.0;  // mean number of false bearings; Poisson distribution
  double view_rad = 0.5;         // half the width of the field with false bearings
  // Whether the stations have detectors. Bearings then belong to tracklets, which also have the
  // size and rate of the object. False tracklets are objects that only one station sees; each lasts
  // for some time and has its own path.
  bool tracklets = false;
  double rate_sd_rad_s = 2e-3;  // error of a tracklet's angular rate
  double breaks_per_s = 0.05;   // rate at which a target's tracklet gets another id
  double false_life_s = 2.0;    // mean life of a false tracklet
  double size_m = 0.5;          // of targets
};

// 1-sigma of a station's rotation about east, north and up.
Eigen::Vector3d rotation_sd_rad(const WorldConfig& config);

// A target's position and velocity at one time.
struct PathPoint {
  Eigen::Vector3d p_enu = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_enu = Eigen::Vector3d::Zero();
};
using Path = std::vector<PathPoint>;  // samples at a rate of kPathHz, from time 0
inline constexpr double kPathHz = 1000.0;

const LocalFrame& site();
PathPoint at(const Path& path, double time_s);

// A path with constant velocity, disturbed by white noise of the acceleration. `disturbance`: the
// square root of its spectral density [m/s^2 per root Hz].
Path cruising(const PathPoint& start, double disturbance, double duration_s,
              std::mt19937_64& random);
// The path of a drone that turns, brakes and climbs: piecewise constant turns and accelerations of
// this size.
Path manoeuvring(const PathPoint& start, double acceleration_m_s2, double duration_s,
                 std::mt19937_64& random);

// The stations' bearings of the targets, in order of time. Bearings of one station in one frame
// have the same stamp.
std::vector<fusion::BearingMeasurement> measure(const WorldConfig& config,
                                                const std::vector<Path>& targets, double duration_s,
                                                std::mt19937_64& random);

// The id of a station. aim_of(): the axis of its camera.
std::string name_of_station(std::size_t station);
AzimuthElevation aim_of(const WorldConfig& config, std::size_t station);

// The positions of n stations on a circle about the origin.
std::vector<Eigen::Vector3d> circle(int n, double radius_m);

}  // namespace ols::bench
