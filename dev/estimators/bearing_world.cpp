#include "dev/estimators/bearing_world.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::bench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d draw(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

// In the field of view, from its middle [rad].
Vector2d anywhere(const WorldConfig& config, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-config.view_rad, config.view_rad);
  const double x = uniform(random), y = uniform(random);
  return {x, y};
}

// What moves before one camera alone: an insect, a leaf.
struct FalseTracklet {
  std::int64_t id = 0;
  double until_s = 0.0;
  AzimuthElevation there;
  Vector2d rate_rad_s = Vector2d::Zero();
  double size_rad = 0.0, signal = 0.0;
};

struct Station {
  std::string id;
  Vector3d p_ecef;                           // true
  Vector3d says_ecef;                        // it says
  Vector3d rotation_rad = Vector3d::Zero();  // about east, north, up
  AzimuthElevation aim;
  std::int64_t next_tracklet = 1;
  std::vector<std::int64_t> of_target;  // the tracklet of each target
  std::vector<FalseTracklet> false_ones;
};

AzimuthElevation direction(const Vector3d& from_ecef, const Vector3d& to_ecef) {
  return azimuth_elevation_from_enu(R_ecef_enu(from_ecef).transpose() * (to_ecef - from_ecef));
}

AzimuthElevation moved(const AzimuthElevation& from, const Vector2d& by_rad) {
  const double elevation = std::clamp(from.elevation_rad + by_rad.y(), -kPi / 2.0, kPi / 2.0);
  return {wrap_two_pi(from.azimuth_rad + by_rad.x() / std::cos(elevation)), elevation};
}

fusion::BearingMeasurement measurement(const WorldConfig& config, const Station& station,
                                       std::int64_t utime_us, const AzimuthElevation& there,
                                       const Vector2d& off_rad) {
  fusion::BearingMeasurement s;
  s.station = station.id;
  s.utime_us = utime_us;
  s.sight.origin_ecef = station.says_ecef;
  s.sight.direction = moved(there, off_rad);
  s.sight.covariance_white = Eigen::Matrix2d::Identity() * config.noise_rad * config.noise_rad;
  if (config.bias_stated) {
    s.sight.origin_sd_enu_m.setConstant(config.place_sd_m);
    const Eigen::Matrix<double, 2, 3> B = shift_by_rotation(tangent_basis(s.sight.direction));
    const Vector3d variance = rotation_sd_rad(config).array().square();
    s.sight.covariance_systematic = B * variance.asDiagonal() * B.transpose();
  }
  return s;
}

void make_tracklet(const WorldConfig& config, std::int64_t id, const Vector2d& rate_rad_s,
                   double size_rad, double signal, std::mt19937_64& random,
                   fusion::BearingMeasurement& bearing) {
  const double variance = config.rate_sd_rad_s * config.rate_sd_rad_s;
  bearing.is_tracklet = true;
  bearing.track_id = id;
  bearing.sighted.rate_rad_s = rate_rad_s + config.rate_sd_rad_s * draw(random).head<2>();
  bearing.sighted.rate_covariance = variance * Eigen::Matrix2d::Identity();
  bearing.sighted.size_sd_rad = 3.0 * config.noise_rad;
  bearing.sighted.size_rad = std::hypot(size_rad, bearing.sighted.size_sd_rad);
  bearing.sighted.signal = signal;
}

// What the detector saw of target k, at its instant.
void see_target(const WorldConfig& config, const Path& path, std::size_t k, double time_s,
                Station& station, std::mt19937_64& random, fusion::BearingMeasurement& bearing) {
  constexpr double kStepS = 0.02, kSignalAt1M = 5e6;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  station.of_target.resize(std::max(station.of_target.size(), k + 1), 0);
  std::int64_t& own = station.of_target[k];
  if (own == 0 || uniform(random) < config.breaks_per_s / config.rate_hz)
    own = station.next_tracklet++;
  const Vector3d p_ecef = site().to_ecef(at(path, time_s).p_enu);
  const AzimuthElevation a = direction(station.p_ecef,
                                       site().to_ecef(at(path, time_s - kStepS).p_enu)),
                         b = direction(station.p_ecef,
                                       site().to_ecef(at(path, time_s + kStepS).p_enu));
  const Vector2d rate(wrap_pi(b.azimuth_rad - a.azimuth_rad) * std::cos(a.elevation_rad),
                      b.elevation_rad - a.elevation_rad);
  const double range_m = (p_ecef - station.p_ecef).norm();
  make_tracklet(config, own, rate / (2.0 * kStepS), config.size_m / range_m,
                kSignalAt1M * config.size_m / (range_m * range_m), random, bearing);
}

void see_false_ones(const WorldConfig& config, double time_s, Station& station,
                    std::mt19937_64& random, std::vector<fusion::BearingMeasurement>& all) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::poisson_distribution<int> born(config.false_per_frame /
                                      (config.false_life_s * config.rate_hz));
  std::exponential_distribution<double> life(1.0 / config.false_life_s);
  std::erase_if(station.false_ones, [&](const FalseTracklet& f) { return f.until_s < time_s; });
  for (int i = born(random); i > 0; --i) {
    const AzimuthElevation there = moved(station.aim, anywhere(config, random));
    station.false_ones.push_back({station.next_tracklet++, time_s + life(random), there,
                                  0.05 * draw(random).head<2>(), 2e-3 * uniform(random),
                                  5.0 + 30.0 * uniform(random)});
  }
  const std::int64_t utime_us = kStartUs + std::llround(time_s * 1e6);
  for (FalseTracklet& f : station.false_ones) {
    f.there = moved(f.there, f.rate_rad_s / config.rate_hz);
    all.push_back(
        measurement(config, station, utime_us, f.there, config.noise_rad * draw(random).head<2>()));
    make_tracklet(config, f.id, f.rate_rad_s, f.size_rad, f.signal, random, all.back());
  }
}

// A Gauss-Markov process.
void wander(const WorldConfig& config, double dt_s, Station& station, std::mt19937_64& random) {
  const double decay = std::exp(-dt_s / config.bias_time_s);
  if (decay == 1.0) return;
  const Vector3d fresh = std::sqrt(1.0 - decay * decay) * rotation_sd_rad(config);
  station.rotation_rad = decay * station.rotation_rad + fresh.cwiseProduct(draw(random));
}

std::vector<Station> stations_of(const WorldConfig& config, std::mt19937_64& random) {
  std::vector<Station> stations;
  for (std::size_t i = 0; i < config.stations_enu.size(); ++i) {
    Station station;
    station.id = name_of_station(i);
    station.p_ecef = site().to_ecef(config.stations_enu[i]);
    station.rotation_rad = rotation_sd_rad(config).cwiseProduct(draw(random));
    station.says_ecef = station.p_ecef;
    if (config.place_sd_m > 0.0) {
      station.says_ecef = site().to_ecef(config.stations_enu[i] + config.place_sd_m * draw(random));
    }
    station.aim = aim_of(config, i);
    stations.push_back(station);
  }
  return stations;
}

}  // namespace

Vector3d rotation_sd_rad(const WorldConfig& config) {
  return {config.bias_sd_rad, config.bias_sd_rad,
          std::hypot(config.bias_sd_rad, config.heading_sd_rad)};
}

// GCC 12 warns wrongly of "s" + std::to_string(i).
std::string name_of_station(std::size_t station) {
  std::string name = "s";
  name += std::to_string(station);
  return name;
}

AzimuthElevation aim_of(const WorldConfig& config, std::size_t station) {
  const Vector3d aim = config.aims_enu.empty() ? Vector3d(0, 0, 80) : config.aims_enu[station];
  return direction(site().to_ecef(config.stations_enu[station]), site().to_ecef(aim));
}

const LocalFrame& site() {
  static const LocalFrame frame({radians(49.2), radians(16.6), 250.0});
  return frame;
}

PathPoint at(const Path& path, double time_s) {
  const double place = std::clamp(time_s * kPathHz, 0.0, static_cast<double>(path.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(place), path.size() - 2);
  const double share = place - static_cast<double>(i);
  return {path[i].p_enu + share * (path[i + 1].p_enu - path[i].p_enu),
          path[i].v_enu + share * (path[i + 1].v_enu - path[i].v_enu)};
}

Path cruising(const PathPoint& start, double disturbance, double duration_s,
              std::mt19937_64& random) {
  Path path = {start};
  const double dt = 1.0 / kPathHz, kick = disturbance * std::sqrt(dt);
  while (static_cast<double>(path.size()) < duration_s * kPathHz + 2.0) {
    PathPoint next = path.back();
    next.p_enu += dt * next.v_enu;
    next.v_enu += kick * draw(random);
    path.push_back(next);
  }
  return path;
}

Path manoeuvring(const PathPoint& start, double acceleration_m_s2, double duration_s,
                 std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  Path path = {start};
  const double dt = 1.0 / kPathHz;
  Vector3d across = Vector3d::Zero();
  double until_s = 0.0, along = 0.0;
  while (static_cast<double>(path.size()) < duration_s * kPathHz + 2.0) {
    PathPoint next = path.back();
    const double time_s = static_cast<double>(path.size()) * dt;
    if (time_s >= until_s) {
      until_s = time_s + 1.0 + 3.0 * uniform(random);
      across = acceleration_m_s2 * uniform(random) * draw(random).normalized();
      along = acceleration_m_s2 * (uniform(random) - 0.5);
      if (next.v_enu.norm() > 20.0) along = -std::abs(along);
      if (next.v_enu.norm() < 4.0) along = std::abs(along);
      // It stays about where it was.
      const Vector3d away = next.p_enu - start.p_enu;
      if (away.norm() > 120.0) across = -acceleration_m_s2 * away.normalized();
    }
    next.p_enu += dt * next.v_enu;
    next.v_enu += dt * (across + along * next.v_enu.normalized());
    path.push_back(next);
  }
  return path;
}

std::vector<fusion::BearingMeasurement> measure(const WorldConfig& config,
                                                const std::vector<Path>& targets, double duration_s,
                                                std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::poisson_distribution<int> false_ones(std::max(1e-12, config.false_per_frame));
  std::vector<Station> stations = stations_of(config, random);
  std::vector<fusion::BearingMeasurement> measurements;
  const auto frames = static_cast<int>(duration_s * config.rate_hz);
  for (int frame = 0; frame < frames; ++frame) {
    for (std::size_t k = 0; k < stations.size(); ++k) {
      const double phase = static_cast<double>(k) / static_cast<double>(stations.size());
      const double time_s = (frame + phase) / config.rate_hz;
      const std::int64_t utime_us = kStartUs + std::llround(time_s * 1e6);
      const std::size_t first = measurements.size();
      wander(config, 1.0 / config.rate_hz, stations[k], random);
      for (std::size_t target = 0; target < targets.size(); ++target) {
        const Path& path = targets[target];
        if (uniform(random) < config.missed) continue;
        const AzimuthElevation there =
            direction(stations[k].p_ecef, site().to_ecef(at(path, time_s).p_enu));
        const Vector2d off = shift_by_rotation(tangent_basis(there)) * stations[k].rotation_rad +
                             config.noise_rad * draw(random).head<2>();
        measurements.push_back(measurement(config, stations[k], utime_us, there, off));
        if (config.tracklets)
          see_target(config, path, target, time_s, stations[k], random, measurements.back());
      }
      if (config.tracklets) see_false_ones(config, time_s, stations[k], random, measurements);
      const bool at_random = config.false_per_frame > 0.0 && !config.tracklets;
      for (int i = at_random ? false_ones(random) : 0; i > 0; --i) {
        const Vector2d off = anywhere(config, random);
        measurements.push_back(measurement(config, stations[k], utime_us, stations[k].aim, off));
      }
      std::shuffle(measurements.begin() + static_cast<std::ptrdiff_t>(first), measurements.end(),
                   random);
      const auto count = static_cast<int>(measurements.size() - first);
      for (std::size_t i = first; config.tracklets && i < measurements.size(); ++i)
        measurements[i].image_bearings = count;
    }
  }
  return measurements;
}

std::vector<Vector3d> circle(int n, double radius_m) {
  std::vector<Vector3d> places;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * kPi * (i + 0.25) / n;
    places.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), 2.0 * (i % 3));
  }
  return places;
}

}  // namespace ols::bench
