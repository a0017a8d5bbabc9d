// Simulated bearings without images: targets fly, and stations measure their directions with noise,
// biases, misses and false bearings. For Monte Carlo runs of the estimators. Deterministic by the
// seed.
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
      {};                 // where each looks, for false bearings; empty: centre
  double rate_hz = 30.0;  // frames of each station, evenly staggered
  double noise_rad = 3e-4;
  double bias_sd_rad = 0.0;      // of each station's rotation about east, north and up: its bias
  double heading_sd_rad = 0.0;   // about up, in addition
  double bias_time_s = 1e12;     // their correlation time: constant
  double place_sd_m = 0.0;       // error of each station's stated position: east, north, up;
                                 // constant
  bool bias_stated = true;       // whether the stations state their errors
  double missed = 0.0;           // share of a station's detections
  double false_per_frame = 0.0;  // mean number, Poisson
  double view_rad = 0.5;         // half width of the field in which false bearings lie
  // Whether the stations have detectors. Bearings then belong to tracklets, which say what was
  // seen. False ones come from objects that only this station sees, each for some time and along
  // its own path.
  bool tracklets = false;
  double rate_sd_rad_s = 2e-3;  // of a tracklet's angular rate
  double breaks_per_s = 0.05;   // how often a target's tracklet gets another id
  double false_life_s = 2.0;    // mean life of a false tracklet
  double size_m = 0.5;          // of targets
};

// 1-sigma of a station's rotation about east, north and up.
Eigen::Vector3d rotation_sd_rad(const WorldConfig& config);

// A target's position at a time, and its velocity.
struct PathPoint {
  Eigen::Vector3d p_enu = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_enu = Eigen::Vector3d::Zero();
};
using Path = std::vector<PathPoint>;  // sampled at kPathHz from 0
inline constexpr double kPathHz = 1000.0;

const LocalFrame& site();
PathPoint at(const Path& path, double time_s);

// Constant velocity, disturbed by white noise of the acceleration [m/s^2 over root Hz].
Path cruising(const PathPoint& start, double disturbance, double duration_s,
              std::mt19937_64& random);
// A drone that turns, brakes and climbs: piecewise constant turns and accelerations of this size.
Path manoeuvring(const PathPoint& start, double acceleration_m_s2, double duration_s,
                 std::mt19937_64& random);

// In order of time. Bearings of one station and frame have the same stamp.
std::vector<fusion::BearingMeasurement> measure(const WorldConfig& config,
                                                const std::vector<Path>& targets, double duration_s,
                                                std::mt19937_64& random);

// The id of a station, and the axis of its camera at the start.
std::string name_of_station(std::size_t station);
AzimuthElevation aim_of(const WorldConfig& config, std::size_t station);

// n stations on a circle about the origin.
std::vector<Eigen::Vector3d> circle(int n, double radius_m);

}  // namespace ols::bench
