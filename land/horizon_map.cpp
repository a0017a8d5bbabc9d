#include "land/horizon_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

#include "geometry/chi_square.h"
#include "land/column_march.h"

namespace ols::land {
namespace {

constexpr double kNone = Staircase::kNone;

// Means of the fifths of a standard normal distribution, each as probable as the others.
constexpr std::array kFifths{-1.39981, -0.53190, 0.0, 0.53190, 1.39981};

// A camera on top of what the model has there is covered by nothing.
struct Standing {
  double lowered_m = 0.0;
  bool covered = false;
};

Standing standing_of(const Surface& surface, const Geodetic& camera) {
  const auto ground = surface.ground(camera.latitude_rad, camera.longitude_rad);
  if (!ground) {
    throw std::invalid_argument("the surface does not know the ground at the camera");
  }
  const double above_m = camera.height_m - ground->height_m;
  if (!(above_m > -3.0 * ground->sd_m)) {
    std::ostringstream text;
    text << "the camera is " << std::lround(-above_m)
         << " m under the ground of the surface, which "
         << "states an error of " << ground->sd_m << " m: the camera's height, the surface's "
         << "vertical datum or its place is wrong";
    throw std::invalid_argument(text.str());
  }
  const auto top = surface.top(camera.latitude_rad, camera.longitude_rad);
  return {std::max(0.0, HorizonMap::kLeastAboveGround_m - above_m),
          top && top->height_m > std::max(camera.height_m, ground->height_m)};
}

}  // namespace

struct HorizonMap::Columns {
  Staircase left, right;
  double share_right = 0.0;

  bool empty() const { return left.empty() || right.empty(); }
  const Staircase& nearer() const { return share_right < 0.5 ? left : right; }
  LandHeight before(double distance_m) const {
    return mix(left.before(left.beyond(distance_m), distance_m),
               right.before(right.beyond(distance_m), distance_m));
  }
  LandHeight mix(const LandHeight& l, const LandHeight& r) const {
    return {l.elevation_rad + share_right * (r.elevation_rad - l.elevation_rad),
            l.sd_rad + share_right * (r.sd_rad - l.sd_rad)};
  }
};

HorizonMap::HorizonMap(const Surface& surface, const Geodetic& camera,
                       const HorizonMapConfig& config)
    : frame_(camera), config_(config), columns_per_rad_(config.columns / (2.0 * kPi)) {
  const Standing standing = standing_of(surface, camera);
  lowered_m_ = standing.lowered_m;
  march_all(surface, standing.covered);
}

void HorizonMap::march_all(const Surface& surface, bool covered) {
  const double column_rad = 2.0 * kPi / config_.columns;
  const MarchSettings settings{.reach_m = config_.reach_m,
                               .least_cell_m = config_.least_cell_m,
                               .cell_per_distance = column_rad,
                               .refraction_k = config_.refraction_k,
                               .refraction_k_sd = config_.refraction_k_sd,
                               .lowered_m = lowered_m_,
                               .covered = covered};
  std::vector<Step> steps;
  for (int column = 0; column < config_.columns; ++column) {
    const double azimuth_rad = column * column_rad;
    const double into_rad = wrap_two_pi(azimuth_rad - config_.from_azimuth_rad);
    steps.clear();
    const double known_to_m =
        into_rad <= config_.sector_rad ? march(surface, frame_, azimuth_rad, settings, steps) : 0.0;
    known_to_m_.push_back(static_cast<float>(known_to_m));
    columns_.add(steps);
  }
}

HorizonMap::Columns HorizonMap::beside(double azimuth_rad) const {
  const double place = wrap_two_pi(azimuth_rad) * columns_per_rad_;
  const int left = std::min(static_cast<int>(place), config_.columns - 1);
  const int right = left + 1 < config_.columns ? left + 1 : 0;
  return {columns_[static_cast<std::size_t>(left)], columns_[static_cast<std::size_t>(right)],
          place - left};
}

double HorizonMap::cell_m(double distance_m) const {
  return std::max(config_.least_cell_m, 2.0 * kPi / config_.columns * distance_m);
}

std::optional<Skyline> HorizonMap::skyline(double azimuth_rad) const {
  return highest_before(azimuth_rad, kNone);
}

std::optional<Skyline> HorizonMap::highest_before(double azimuth_rad, double distance_m) const {
  const Columns columns = beside(azimuth_rad);
  if (columns.empty()) return std::nullopt;
  const LandHeight height = columns.before(distance_m);
  const Staircase& own = columns.nearer();
  const double own_rad = own.before(own.beyond(distance_m), distance_m).elevation_rad;
  return Skyline{height.elevation_rad, height.sd_rad,
                 std::min(distance_m, own.distance_at(own_rad))};
}

std::optional<GroundHit> HorizonMap::ground(const AzimuthElevation& sight) const {
  const Columns columns = beside(sight.azimuth_rad);
  if (columns.empty()) return std::nullopt;
  const double left_m = columns.left.distance_at(sight.elevation_rad);
  const double right_m = columns.right.distance_at(sight.elevation_rad);
  double near_m = std::min(left_m, right_m), far_m = std::max(left_m, right_m);
  if (far_m == kNone) {
    far_m = config_.reach_m;
    if (near_m == kNone || columns.before(kNone).elevation_rad < sight.elevation_rad) {
      return std::nullopt;
    }
  }
  // Between the two columns the staircase is between theirs.
  while (far_m - near_m > 0.05 * cell_m(near_m)) {
    const double middle_m = 0.5 * (near_m + far_m);
    const bool below = columns.before(middle_m).elevation_rad < sight.elevation_rad;
    (below ? near_m : far_m) = middle_m;
  }
  const double step_m = 0.5 * std::min(cell_m(far_m), far_m);
  const LandHeight nearer = columns.before(far_m - step_m),
                   farther = columns.before(far_m + step_m);
  const auto range_m = [](double distance_m, const LandHeight& at) {
    return distance_m / std::cos(at.elevation_rad);
  };
  const bool is_first = nearer.elevation_rad <= -0.5 * kPi;
  return GroundHit{.range_m = far_m / std::cos(sight.elevation_rad),
                   .elevation_sd_rad = columns.before(far_m).sd_rad,
                   .rise_rad_per_m = is_first ? 0.0
                                              : (farther.elevation_rad - nearer.elevation_rad) /
                                                    (range_m(far_m + step_m, farther) -
                                                     range_m(far_m - step_m, nearer))};
}

// A point on one azimuth, as normally distributed as is known.
struct HorizonMap::OnAzimuth {
  double distance_m, distance_sd_m;
  double elevation_rad, rise_rad;  // mean; change by one sigma of distance
  double elevation_sd_rad;         // for a given distance
};

namespace {

double probability_above(double above_rad, double sd_rad) {
  if (sd_rad == 0.0) return above_rad > 0.0 ? 1.0 : 0.0;
  return normal_level(-above_rad / sd_rad);
}

}  // namespace

// The sum over distances `offsets` sigmas from the mean; the offsets ascend. Most points are
// clearly above or below all land up to there: then, two look-ups decide.
double HorizonMap::sum_visible(const Columns& columns, const OnAzimuth& point,
                               std::span<const double> offsets) {
  constexpr double kClear = 6.0;  // sigmas
  const auto distance_m = [&](double offset) {
    return point.distance_m + point.distance_sd_m * offset;
  };
  const auto sd_rad = [&](double land_sd_rad) {
    return std::sqrt(point.elevation_sd_rad * point.elevation_sd_rad + land_sd_rad * land_sd_rad);
  };
  const double from_m = distance_m(offsets.front()), to_m = distance_m(offsets.back());
  std::size_t left = columns.left.beyond(from_m), right = columns.right.beyond(from_m);
  const auto land_before = [&](double at_m) {
    left = columns.left.beyond_from(left, at_m);
    right = columns.right.beyond_from(right, at_m);
    return columns.mix(columns.left.before(left, at_m), columns.right.before(right, at_m));
  };
  const std::size_t first_left = left, first_right = right;
  const LandHeight nearest = land_before(from_m), farthest = land_before(to_m);
  const double land_sd_rad =
      std::max({nearest.sd_rad, farthest.sd_rad, columns.left.greatest_sd_rad(first_left, left),
                columns.right.greatest_sd_rad(first_right, right)});
  const double clear_rad = kClear * sd_rad(land_sd_rad);
  const double half_rad = std::abs(point.rise_rad) * offsets.back();
  if (point.elevation_rad - half_rad > farthest.elevation_rad + clear_rad)
    return static_cast<double>(offsets.size());
  if (point.elevation_rad + half_rad < nearest.elevation_rad - clear_rad) return 0.0;
  left = first_left;
  right = first_right;
  double sum = 0.0;
  for (const double offset : offsets) {
    const LandHeight land = land_before(distance_m(offset));
    const double elevation_rad = point.elevation_rad + point.rise_rad * offset;
    sum += probability_above(elevation_rad - land.elevation_rad, sd_rad(land.sd_rad));
  }
  return sum;
}

// Azimuth, distance and elevation of the point are jointly normal. Over azimuth and distance the
// mean is taken by the fifths of each, over the elevation, given both, in closed form.
double HorizonMap::visible_probability(const Eigen::Vector3d& p_ecef,
                                       const Eigen::Matrix3d& covariance_ecef) const {
  const Eigen::Vector3d enu = frame_.to_enu(p_ecef);
  const double distance_m = enu.head<2>().norm();
  if (distance_m == 0.0) return enu.z() > 0.0 ? 1.0 : 0.0;
  const double azimuth_rad = std::atan2(enu.x(), enu.y());
  const Eigen::Vector2d outward = enu.head<2>() / distance_m;
  const double range2 = enu.squaredNorm();
  Eigen::Matrix3d J;  // azimuth, distance, elevation by east, north, up
  J << outward.y() / distance_m, -outward.x() / distance_m, 0.0,  //
      outward.x(), outward.y(), 0.0,                              //
      -enu.z() * outward.x() / range2, -enu.z() * outward.y() / range2, distance_m / range2;
  const Eigen::Matrix3d to_polar = J * frame_.R_ecef_enu().transpose();
  const Eigen::Matrix3d P = to_polar * covariance_ecef * to_polar.transpose();

  // P = L L^T; a dimension without variance has zeros.
  const auto root = [](double variance) { return std::sqrt(std::max(variance, 0.0)); };
  const auto over = [](double value, double by) { return by > 0.0 ? value / by : 0.0; };
  const double l00 = root(P(0, 0)), l10 = over(P(1, 0), l00), l20 = over(P(2, 0), l00);
  const double l11 = root(P(1, 1) - l10 * l10), l21 = over(P(2, 1) - l20 * l10, l11);
  const double l22 = root(P(2, 2) - l20 * l20 - l21 * l21);

  const double lift_rad = refraction_slope(config_.refraction_k, distance_m);
  const double elevation_rad = std::atan(enu.z() / distance_m + lift_rad);
  const auto fifths = [](double sd, double fine) {
    return sd > fine ? std::span<const double>(kFifths) : std::span<const double>(&kFifths[2], 1);
  };
  double sum = 0.0;
  const auto across = fifths(l00, 0.1 * 2.0 * kPi / config_.columns);
  const auto along = fifths(l11, 0.1 * cell_m(distance_m));
  for (const double a : across) {
    const Columns columns = beside(azimuth_rad + l00 * a);
    if (columns.empty()) {
      sum += static_cast<double>(along.size());
      continue;
    }
    sum +=
        sum_visible(columns, {distance_m + l10 * a, l11, elevation_rad + l20 * a, l21, l22}, along);
  }
  return sum / static_cast<double>(across.size() * along.size());
}

double HorizonMap::known_to_m(double azimuth_rad) const {
  const double place = wrap_two_pi(azimuth_rad) * columns_per_rad_;
  return known_to_m_[static_cast<std::size_t>(std::lround(place) % config_.columns)];
}

}  // namespace ols::land
