#include "sim/world/relief.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/angles.h"

namespace ols::sim {
namespace {

constexpr std::uint64_t kRoughnessSeed = 17;
constexpr double kNothing = -1e9;

// Along a heading (clockwise from north), and to its right.
Eigen::Vector2d turned(const Eigen::Vector2d& off_m, double heading_rad) {
  const double s = std::sin(heading_rad), c = std::cos(heading_rad);
  return {off_m.x() * s + off_m.y() * c, off_m.x() * c - off_m.y() * s};
}

// The earth falls away below the site's plane.
double fall_m(const Eigen::Vector2d& place_m) {
  constexpr double kEarth_m = 6'371'000.0;
  return place_m.squaredNorm() / (2.0 * kEarth_m);
}

}  // namespace

Eigen::Vector2d House::corner_m(int index) const {
  const double along = (index == 0 || index == 3 ? -0.5 : 0.5) * size_m.x();
  const double right = (index < 2 ? -0.5 : 0.5) * size_m.y();
  const double s = std::sin(heading_rad), c = std::cos(heading_rad);
  return centre_m + Eigen::Vector2d(along * s + right * c, along * c - right * s);
}

bool House::covers(const Eigen::Vector2d& place_m) const {
  const Eigen::Vector2d own = turned(place_m - centre_m, heading_rad);
  return std::abs(own.x()) <= 0.5 * size_m.x() && std::abs(own.y()) <= 0.5 * size_m.y();
}

Waves::Waves(double sd_m, double length_m, std::uint64_t seed)
    : amplitude_m_(sd_m * std::sqrt(2.0 / kWaves)) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < kWaves; ++i) {
    const double direction = 2.0 * kPi * uniform(generator);
    const double wave = 2.0 * kPi / (length_m * (0.7 + 0.6 * uniform(generator)));
    wave_rad_m_.row(i) << wave * std::cos(direction), wave * std::sin(direction);
    phase_rad_(i) = 2.0 * kPi * uniform(generator);
  }
}

double Waves::at(const Eigen::Vector2d& place_m) const {
  return amplitude_m_ * (wave_rad_m_ * place_m + phase_rad_).array().cos().sum();
}

// In two dimensions the waves of such a field have wave numbers k of which a share of
// 1 - 1 / sqrt(1 + (k length)^2) is smaller.
ErrorField::ErrorField(double sd_m, double length_m, std::uint64_t seed)
    : amplitude_m_(static_cast<float>(sd_m * std::sqrt(2.0 / kWaves))) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < kWaves; ++i) {
    const double direction = 2.0 * kPi * uniform(generator);
    const double longer = 1.0 - (i + uniform(generator)) / kWaves;
    const double wave = std::sqrt(1.0 / (longer * longer) - 1.0) / length_m;
    wave_rad_m_(i, 0) = static_cast<float>(wave * std::cos(direction));
    wave_rad_m_(i, 1) = static_cast<float>(wave * std::sin(direction));
    phase_rad_(i) = static_cast<float>(2.0 * kPi * uniform(generator));
  }
}

double ErrorField::at(const Eigen::Vector2d& place_m) const {
  const auto x = static_cast<float>(place_m.x()), y = static_cast<float>(place_m.y());
  const auto phases_rad = x * wave_rad_m_.col(0) + y * wave_rad_m_.col(1) + phase_rad_;
  return amplitude_m_ * phases_rad.cos().sum();
}

Relief::Relief(const ReliefScenario& scenario)
    : scenario_(scenario),
      roughness_(scenario.roughness_m, scenario.roughness_length_m, kRoughnessSeed) {
  for (const House& house : scenario_.houses) {
    double lowest_m = ground_m(house.corner_m(0));
    for (int i = 1; i < 4; ++i) lowest_m = std::min(lowest_m, ground_m(house.corner_m(i)));
    roofs_m_.push_back(lowest_m + house.size_m.z());
  }
}

double Relief::ground_m(const Eigen::Vector2d& place_m) const {
  double height_m = roughness_.at(place_m);
  for (const Hill& hill : scenario_.hills) {
    const Eigen::Vector2d own = turned(place_m - hill.centre_m, hill.heading_rad);
    height_m += hill.height_m * std::exp(-0.5 * own.cwiseQuotient(hill.width_m).squaredNorm());
  }
  return height_m;
}

double Relief::top_m(const Eigen::Vector2d& place_m) const {
  const double own_m = ground_m(place_m);
  double top_m = own_m;
  for (std::size_t i = 0; i < roofs_m_.size(); ++i) {
    if (scenario_.houses[i].covers(place_m)) top_m = std::max(top_m, roofs_m_[i]);
  }
  for (const Tree& tree : scenario_.trees) {
    const bool under = (place_m - tree.centre_m).squaredNorm() <= tree.radius_m * tree.radius_m;
    if (under) top_m = std::max(top_m, own_m + tree.height_m);
  }
  return top_m;
}

double Relief::highest_slope(const Eigen::Vector3d& camera_enu, const Eigen::Vector2d& outward,
                             double distance_m) const {
  constexpr double kReach_m = 10e3, kBegin_m = 2.0, kLeastStep_m = 0.5, kStepShare = 0.002;
  double highest = kNothing;
  const double end_m = std::min(distance_m, kReach_m);
  for (double at_m = kBegin_m; at_m < end_m; at_m += std::max(kLeastStep_m, kStepShare * at_m)) {
    const Eigen::Vector2d place_m = camera_enu.head<2>() + at_m * outward;
    const double up_m = top_m(place_m) - fall_m(place_m) - camera_enu.z();
    highest = std::max(highest, up_m / at_m);
  }
  return highest;
}

bool Relief::hides(const Eigen::Vector3d& camera_enu, const Eigen::Vector3d& target_enu) const {
  constexpr double kBegin_m = 2.0, kLeastStep_m = 0.5, kStepShare = 0.25;
  const Eigen::Vector3d line = target_enu - camera_enu;
  const double range_m = line.norm();
  for (double at_m = kBegin_m; at_m < range_m;) {
    const Eigen::Vector3d p = camera_enu + at_m / range_m * line;
    const Eigen::Vector2d place_m = p.head<2>();
    const double above_m = p.z() + fall_m(place_m) - top_m(place_m);
    if (above_m < 0.0) return true;
    // Nothing is thinner than it is high.
    at_m += std::max(kLeastStep_m, kStepShare * above_m);
  }
  return false;
}

}  // namespace ols::sim
