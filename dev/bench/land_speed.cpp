// Google Benchmark of a station's map of the land: made over 30 km of hilly land in a grid of an
// arc second with 20 000 buildings, and asked. And the best four of 200 places that see over an
// area of 10 km by 10 km. Processor time of one thread.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "geometry/angles.h"
#include "geometry/placement.h"
#include "land/horizon_map.h"
#include "land/terrain.h"
#include "tools/offline/planned_land.h"

namespace {

using namespace ols;
using namespace ols::land;

constexpr int kSize = 2200;  // of the grid: 68 km from south to north
constexpr double kStep_rad = radians(1.0 / 3600.0);
const Geodetic kCamera{radians(46.0), radians(9.0), 420.0};

std::vector<float> hills() {
  std::vector<float> heights;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const double y = row * 0.01, x = column * 0.01;
      heights.push_back(static_cast<float>(
          400.0 + 250.0 * std::sin(x) * std::sin(0.8 * y) + 60.0 * std::sin(4.1 * x + 1.3 * y) +
          15.0 * std::sin(11.0 * y - 7.0 * x) + 3.0 * std::sin(40.0 * x) * std::cos(37.0 * y)));
    }
  }
  return heights;
}

std::vector<Covering> buildings() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.002, 0.002), size(1e-6, 4e-6);
  std::vector<Covering> all(20'000);
  for (Covering& one : all) {
    const Eigen::Vector2d at(kCamera.longitude_rad + place(random),
                             kCamera.latitude_rad + place(random));
    const Eigen::Vector2d to = at + Eigen::Vector2d(size(random), size(random));
    one.rings = {{at, {to.x(), at.y()}, to, {at.x(), to.y()}}};
    one.height_m = 9.0;
    one.sd_m = 1.0;
  }
  return all;
}

const Terrain& land() {
  static const auto heights = std::make_shared<const std::vector<float>>(hills());
  static const Terrain terrain(
      {{kCamera.latitude_rad + kSize / 2 * kStep_rad, kCamera.longitude_rad - kSize / 2 * kStep_rad,
        kStep_rad, kStep_rad, kSize, kSize, 4.0, *heights}},
      buildings(), heights);
  return terrain;
}

Geodetic camera() {
  Geodetic camera = kCamera;
  camera.height_m = land().top(camera.latitude_rad, camera.longitude_rad)->height_m + 10.0;
  return camera;
}

const HorizonMap& map() {
  static const HorizonMap map(land(), camera());
  return map;
}

void make_map(benchmark::State& state) {
  const Geodetic at = camera();
  std::size_t steps = 0;
  for ([[maybe_unused]] auto _ : state) steps = HorizonMap(land(), at).step_count();
  state.counters["steps"] = static_cast<double>(steps);
}

// Azimuths that do not follow one another, as those of many targets.
template <class Ask>
void ask(benchmark::State& state, Ask ask) {
  const HorizonMap& of_land = map();
  double azimuth_rad = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    azimuth_rad = wrap_two_pi(azimuth_rad + 2.39996);
    benchmark::DoNotOptimize(ask(of_land, azimuth_rad));
  }
}

void skyline(benchmark::State& state) {
  ask(state, [](const HorizonMap& map, double azimuth_rad) { return map.skyline(azimuth_rad); });
}

void range_of_ground(benchmark::State& state) {
  ask(state, [](const HorizonMap& map, double azimuth_rad) {
    return map.ground({azimuth_rad, radians(-0.3)});
  });
}

// `sd_m`: of the point, in each direction.
void visible(benchmark::State& state) {
  const LocalFrame frame(camera());
  const double sd_m = static_cast<double>(state.range(0));
  const Eigen::Matrix3d covariance = sd_m * sd_m * Eigen::Matrix3d::Identity();
  ask(state, [&](const HorizonMap& map, double azimuth_rad) {
    const Eigen::Vector3d enu(5000.0 * std::sin(azimuth_rad), 5000.0 * std::cos(azimuth_rad),
                              100.0);
    return map.visible_probability(frame.to_ecef(enu), covariance);
  });
}

double ground_m(const Geodetic& at) {
  return land().ground(at.latitude_rad, at.longitude_rad)->height_m;
}

// Points 250 m apart at two heights, and cameras 2 m above the ground anywhere in the area.
void place_four_of_200(benchmark::State& state) {
  const LocalFrame frame(kCamera);
  const auto at = [&](double east_m, double north_m, double above_m) {
    Geodetic place = geodetic_from_ecef(frame.to_ecef({east_m, north_m, 0.0}));
    place.height_m = ground_m(place) + above_m;
    return place;
  };
  std::size_t undetermined = 0;
  for ([[maybe_unused]] auto _ : state) {
    PlacementProblem problem;
    problem.stations = 4;
    problem.within_m = 10.0;
    for (double east_m = -5000.0; east_m <= 5000.0; east_m += 250.0) {
      for (double north_m = -5000.0; north_m <= 5000.0; north_m += 250.0) {
        for (const double above_m : {100.0, 300.0}) {
          problem.area.push_back({ecef_from_geodetic(at(east_m, north_m, above_m))});
        }
      }
    }
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> anywhere_m(-5000.0, 5000.0);
    for (int i = 0; i < 200; ++i) {
      const Geodetic place = at(anywhere_m(random), anywhere_m(random), 2.0);
      PlannedStation& station = problem.places.emplace_back();
      station = {LocalFrame(place), 5e-5, {}, 0.0};
      offline::hide_behind(
          std::make_shared<HorizonMap>(
              land(), place,
              HorizonMapConfig{.columns = offline::kPlanColumns, .reach_m = 14'000.0}),
          station);
    }
    undetermined = place_stations(problem, random).undetermined;
  }
  state.counters["undetermined"] = static_cast<double>(undetermined);
}

BENCHMARK(make_map)->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK(place_four_of_200)->Unit(benchmark::kSecond)->Iterations(1);
BENCHMARK(skyline);
BENCHMARK(range_of_ground);
BENCHMARK(visible)->Arg(0)->Arg(20)->ArgName("sd_m");

}  // namespace

BENCHMARK_MAIN();
