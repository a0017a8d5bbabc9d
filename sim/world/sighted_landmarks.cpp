#include "sim/world/sighted_landmarks.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include "calibration/stationing.h"

namespace ols::sim {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kLandmarkTag = 4000, kMarkTag = 4100;

// A sighted point: its stated and its true position.
struct Sighted {
  std::string id;
  Vector3d told_ecef, true_ecef;
  double sd_m = 0.0;  // of the stated position
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}
  double normal() { return normal_(generator_); }
  Vector3d vector() {
    Vector3d v;
    for (double& component : v) component = normal();
    return v;
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

std::vector<Sighted> landmarks(const StationingScenario& s, double on, std::uint64_t seed) {
  Draw draw(derived_seed(seed, kLandmarkTag));
  std::vector<Sighted> all;
  for (const auto& landmark : s.landmarks) {
    const double sd_m = on * landmark.sd_m;
    all.push_back({landmark.id, landmark.p_ecef, landmark.p_ecef + sd_m * draw.vector(), sd_m});
  }
  return all;
}

// The other stations' camera centres, each marked at a slightly wrong point.
std::vector<Sighted> others(const std::vector<StationTruth>& stations, std::size_t own,
                            double mark_sd_m, Draw& draw) {
  std::vector<Sighted> all;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    if (i == own) continue;
    const StationTruth& other = stations[i];
    const Vector3d marked_ecef = camera_centre_ecef(other.truth, {}) + mark_sd_m * draw.vector();
    all.push_back({other.id, camera_centre_ecef(other.nominal, {}), marked_ecef,
                   std::hypot(mark_sd_m, other.nominal.sd.position_m)});
  }
  return all;
}

double stepped(double angle_rad, double step_rad) {
  return step_rad * std::round(angle_rad / step_rad);
}

calibration::LandmarkSighting sighting(const StationTruth& station, const Sighted& sighted,
                                       double mark_sd_px, double step_rad, Draw& draw) {
  const auto angles = aim_at(station.truth, sighted.true_ecef);
  if (!angles) {
    throw std::invalid_argument("station " + station.id + " cannot be turned to " + sighted.id);
  }
  calibration::LandmarkSighting s;
  s.landmark_ecef = sighted.told_ecef;
  s.landmark_sd_m = sighted.sd_m;
  s.pixel = view(station.truth, *angles, sighted.true_ecef).value().pixel;
  s.pixel.x() += mark_sd_px * draw.normal();
  s.pixel.y() += mark_sd_px * draw.normal();
  s.pixel_sd_px = mark_sd_px;
  s.angles = {stepped(angles->pan_rad, step_rad), stepped(angles->tilt_rad, step_rad)};
  s.angles_sd_rad = step_rad / std::sqrt(12.0);
  return s;
}

}  // namespace

void find_headings(const Scenario& scenario, std::uint64_t seed, double step_rad,
                   std::vector<StationTruth>& stations) {
  const StationingScenario& how = scenario.stationing;
  const double on = scenario.errors.heading.on ? 1.0 : 0.0;
  const std::vector<Sighted> common = landmarks(how, on, seed);
  const std::vector<StationTruth> before = stations;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    Draw draw(derived_seed(seed, kMarkTag + i));
    const std::vector<Sighted> sighted = how.by == StationingBy::kLandmarks
                                             ? common
                                             : others(before, i, on * how.each_other_sd_m, draw);
    std::vector<calibration::LandmarkSighting> sightings;
    sightings.reserve(sighted.size());
    for (const Sighted& each : sighted) {
      sightings.push_back(sighting(before[i], each, on * how.mark_sd_px, step_rad, draw));
    }
    // There are no gross errors here, so the test would be wrong in one stationing of a thousand.
    constexpr calibration::Levels kLevels{.mistaken = 1e-12};
    stations[i].nominal =
        calibration::station_by_landmarks(before[i].nominal, sightings, how.highest_rad, kLevels)
            .station;
  }
}

}  // namespace ols::sim
