#include "dev/bench/scenery_site.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::bench {
namespace {

constexpr double kSea_m = 61.0;  // above the ellipsoid, around the Azores
constexpr double kMast_m = 8.0;

Eigen::Vector2d right_of(const Eigen::Vector2d& along) { return {along.y(), -along.x()}; }

bool is_seen(const TrueGround& ground, const Eigen::Vector3d& camera,
             const Eigen::Vector2d& place) {
  constexpr int kSteps = 40;
  constexpr double kHigh_m = 3.0;
  const double height_m = ground.model_height_m(place.x(), place.y());
  const Eigen::Vector3d top(place.x(), place.y(), height_m + kHigh_m);
  for (int i = 1; i < kSteps; ++i) {
    const Eigen::Vector3d p = camera + (top - camera) * i / kSteps;
    if (ground.model_height_m(p.x(), p.y()) > p.z()) return false;
  }
  return true;
}

double seen_share(const TrueGround& ground, const ScenerySite& site, double from_m, double to_m) {
  constexpr double kShore_m = 14.0;
  int count = 0, seen = 0;
  for (int i = 0; i <= 5; ++i) {
    for (int j = -2; j <= 2; ++j) {
      const Eigen::Vector2d place =
          site.along * (from_m + (to_m - from_m) * i / 5) + right_of(site.along) * 200.0 * j;
      ++count;
      const double height_m = ground.model_height_m(place.x(), place.y());
      const bool is_land = height_m + site.middle.height_m > kSea_m + kShore_m;
      seen += is_land && std::ranges::all_of(site.cameras_enu_m, [&](const auto& camera) {
                return is_seen(ground, camera, place);
              });
    }
  }
  return static_cast<double>(seen) / count;
}

bool is_gentle(const TrueGround& ground, const Eigen::Vector2d& along) {
  for (const double distance_m : {1000.0, 2000.0, 3000.0}) {
    const Eigen::Vector2d place = along * distance_m;
    const double height_m = ground.model_height_m(place.x(), place.y());
    if (!(std::abs(height_m) < distance_m * std::tan(radians(5.0)))) return false;
  }
  return true;
}

std::optional<ScenerySite> site_at(const land::TerrainFolder& folder, const Geodetic& place,
                                   double heading_rad, double baseline_m, std::uint64_t seed) {
  const auto known = folder.terrain->ground(place.latitude_rad, place.longitude_rad);
  if (!known || known->height_m < kSea_m + 9.0) return std::nullopt;
  ScenerySite site{.middle = place, .along = {std::sin(heading_rad), std::cos(heading_rad)}};
  site.middle.height_m = known->height_m;
  const TrueGround ground(*folder.terrain, site.middle, seed);
  if (!is_gentle(ground, site.along)) return std::nullopt;
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector2d foot = right_of(site.along) * baseline_m * (i == 0 ? -0.5 : 0.5);
    site.cameras_enu_m[i] << foot, ground.height_m(foot.x(), foot.y()) + kMast_m;
    if (!site.cameras_enu_m[i].allFinite()) return std::nullopt;
  }
  site.seen =
      std::min(seen_share(ground, site, 800.0, 1300.0), seen_share(ground, site, 2500.0, 3500.0));
  return site;
}

}  // namespace

TrueGround::TrueGround(const land::Surface& model, const Geodetic& middle, std::uint64_t seed)
    : model_(model), frame_(middle), errors_(1.0, 300.0, seed), roughness_(0.3, 12.0, seed + 7) {}

double TrueGround::height_m(double east_m, double north_m) const {
  const double height_m = model_height_m(east_m, north_m);
  if (height_m + frame_.origin().height_m < kSea_m) return height_m;
  const auto here = model_.ground(frame_.origin().latitude_rad, frame_.origin().longitude_rad);
  return height_m + here->sd_m * errors_.at({east_m, north_m}) + roughness_.at({east_m, north_m});
}

double TrueGround::model_height_m(double east_m, double north_m) const {
  constexpr double kEarth_m = 6'371'000.0;
  const Geodetic place = geodetic_from_ecef(frame_.to_ecef({east_m, north_m, 0.0}));
  const auto known = model_.ground(place.latitude_rad, place.longitude_rad);
  if (!known) return std::numeric_limits<double>::quiet_NaN();
  // The earth falls away below the frame's plane.
  const double fall_m = (east_m * east_m + north_m * north_m) / (2.0 * kEarth_m);
  return known->height_m - frame_.origin().height_m - fall_m;
}

ScenerySite find_site(const land::TerrainFolder& folder, double baseline_m, std::uint64_t seed) {
  constexpr int kTries = 4000;
  constexpr double kWithin_rad = radians(0.15);
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  ScenerySite best;
  for (int i = 0; i < kTries; ++i) {
    const double north = uniform(generator), east = uniform(generator);
    const double heading_rad = kPi * uniform(generator);
    const Geodetic place{radians(folder.manifest.latitude_deg) + kWithin_rad * north,
                         radians(folder.manifest.longitude_deg) + kWithin_rad * east, 0.0};
    const auto site = site_at(folder, place, heading_rad, baseline_m, seed);
    if (site && site->seen > best.seen) best = *site;
  }
  if (best.seen == 0.0) throw std::invalid_argument("no place in the folder sees enough land");
  return best;
}

}  // namespace ols::bench
