#include "edge/skyline/skyline_heading.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/angles.h"
#include "land/column_march.h"

namespace ols::skyline {
namespace {

constexpr int kUnknowns = 8, kUp = 6;
using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;
using Design =
    Eigen::Matrix<double, Eigen::Dynamic, kUnknowns + 1>;  // the last column: differences
using Normal = Eigen::Matrix<double, kUnknowns + 1, kUnknowns + 1>;

constexpr int kLeastPlaces = 100;

// One place of the seen skyline beside the model.
struct Place {
  Eigen::Matrix<double, 1, kUnknowns + 1> row;
  Eigen::Vector2d crest_m;  // where the land's skyline is: east, north
  double model_sd_rad = 0.0;
  double white_rad2 = 0.0;  // variance of what neighbours do not share
};

// Between the azimuths where the skyline is kSmooth_m away on both sides. The errors of a model
// make its skyline rough: a slope over less would be of these errors, and would seem to tell much.
std::optional<double> slope_at(const land::HorizonMap& map, double azimuth_rad, double distance_m) {
  constexpr double kSmooth_m = land::kLowered_m / 3.0;
  constexpr double kLeast_rad = radians(0.1), kMost_rad = radians(5.0);
  const double step_rad = std::clamp(kSmooth_m / distance_m, kLeast_rad, kMost_rad);
  const auto left = map.skyline(azimuth_rad - step_rad);
  const auto right = map.skyline(azimuth_rad + step_rad);
  if (!left || !right) return std::nullopt;
  return (right->elevation_rad - left->elevation_rad) / (2.0 * step_rad);
}

std::optional<Place> place_of(const SeenPlace& seen, const land::HorizonMap& map, double turn_rad) {
  // Of the model's error: trees, and what is between its heights. Of each place anew.
  constexpr double kRough = 0.5;
  const double azimuth_rad = seen.direction.azimuth_rad + turn_rad;
  const auto skyline = uncertain_skyline(map, azimuth_rad);
  if (!skyline) return std::nullopt;
  const double d = std::max(1.0, skyline->distance_m), rise = std::tan(skyline->elevation_rad);
  const auto known_slope = slope_at(map, azimuth_rad, d);
  if (!known_slope) return std::nullopt;
  const double slope = *known_slope;
  const double s = std::sin(azimuth_rad), c = std::cos(azimuth_rad);
  const double refraction = land::refraction_slope(1.0, d);
  Place place;
  place.row << slope, 1.0, s, c, (slope * c + rise * s) / d, (-slope * s + rise * c) / d, -1.0 / d,
      refraction, seen.direction.elevation_rad - skyline->elevation_rad;
  place.crest_m = d * Eigen::Vector2d(s, c);
  const double bent_rad = map.config().refraction_k_sd * refraction;
  const double sd_rad = skyline->elevation_sd_rad;
  place.model_sd_rad = std::sqrt(std::max(0.0, sd_rad * sd_rad - bent_rad * bent_rad));
  place.white_rad2 = seen.variance_rad2 + std::pow(kRough * place.model_sd_rad, 2);
  return place;
}

std::vector<Place> places_of(const std::vector<SeenPlace>& seen, const land::HorizonMap& map,
                             double turn_rad) {
  std::vector<Place> places;
  for (const SeenPlace& one : seen) {
    if (auto place = place_of(one, map, turn_rad)) places.push_back(*std::move(place));
  }
  return places;
}

// B^T W B, where W is the inverse of the covariance of the differences and B their design with the
// differences themselves: K along the skyline, and white noise beside it. By Woodbury's identity,
// because the inverse of K is tridiagonal. `weights` of 0 leave places out.
Normal normal_matrix(const std::vector<Place>& places, const Eigen::VectorXd& weights) {
  const auto n = static_cast<Eigen::Index>(places.size());
  Design B(n, kUnknowns + 1), C(n, kUnknowns + 1);
  Eigen::VectorXd diagonal = Eigen::VectorXd::Ones(n), beside = Eigen::VectorXd::Zero(n);
  Normal normal = Normal::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Place& place = places[static_cast<std::size_t>(i)];
    const double weight = weights(i) / place.white_rad2;
    B.row(i) = place.row;
    C.row(i) = weight * place.model_sd_rad * place.row;
    normal += weight * place.row.transpose() * place.row;
    diagonal(i) += weight * place.model_sd_rad * place.model_sd_rad;
    if (i == 0) continue;
    const double gap_m = (place.crest_m - places[static_cast<std::size_t>(i - 1)].crest_m).norm();
    const double alike = std::min(0.9999, std::exp(-gap_m / land::kLowered_m));
    const double other = alike * alike / (1.0 - alike * alike);
    diagonal(i - 1) += other;
    diagonal(i) += other;
    beside(i) = -alike / (1.0 - alike * alike);
  }
  // The tridiagonal matrix is L D L^T; `C` becomes L^-1 C.
  for (Eigen::Index i = 1; i < n; ++i) {
    const double factor = beside(i) / diagonal(i - 1);
    diagonal(i) -= factor * beside(i);
    C.row(i) -= factor * C.row(i - 1);
  }
  return normal - C.transpose() * diagonal.cwiseInverse().asDiagonal() * C;
}

struct Solution {
  Unknowns x;
  Eigen::Matrix<double, kUnknowns, kUnknowns> covariance;
  double misfit = 0.0;  // squared, of all places
};

// The first unknown is a turn beyond `turn_rad`; its prior is about no turn at all.
Solution solve(const Normal& normal, const Unknowns& prior_sd, double turn_rad) {
  Eigen::Matrix<double, kUnknowns, kUnknowns> A = normal.topLeftCorner<kUnknowns, kUnknowns>();
  A.diagonal() += prior_sd.cwiseAbs2().cwiseInverse();
  Solution solution;
  solution.covariance = A.ldlt().solve(Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity());
  Unknowns right = normal.topRightCorner<kUnknowns, 1>();
  right(0) -= turn_rad / (prior_sd(0) * prior_sd(0));
  solution.x = solution.covariance * right;
  solution.misfit = normal(kUnknowns, kUnknowns) - solution.x.dot(right);
  return solution;
}

// A tree, a house or a cloud counts less, the farther it is from the rest.
Eigen::VectorXd weights_of(const std::vector<Place>& places, const Unknowns& x) {
  constexpr double kUsual = 2.5;  // sigmas
  Eigen::VectorXd weights(static_cast<Eigen::Index>(places.size()));
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const Place& place = places[static_cast<std::size_t>(i)];
    const double off_rad = place.row(kUnknowns) - place.row.head<kUnknowns>().dot(x);
    const double sd_rad = std::sqrt(place.white_rad2 + std::pow(place.model_sd_rad, 2));
    weights(i) = std::pow(std::min(1.0, kUsual * sd_rad / std::abs(off_rad)), 4);
  }
  return weights;
}

}  // namespace

std::optional<SkylineHeading> skyline_heading(const std::vector<SeenPlace>& seen,
                                              const land::HorizonMap& map,
                                              const StationSd& station) {
  constexpr int kIterations = 6;
  constexpr double kStep_rad = radians(0.2);
  Unknowns prior_sd;
  prior_sd << station.heading_rad, station.tilt_rad, station.tilt_rad, station.tilt_rad,
      station.place_enu_m, map.config().refraction_k_sd;
  double turn_rad = 0.0;  // of the seen directions, to those of the model
  Unknowns others = Unknowns::Zero();
  for (int i = 0;; ++i) {
    const auto places = places_of(seen, map, turn_rad);
    if (places.size() < kLeastPlaces) return std::nullopt;
    const Eigen::VectorXd weights = weights_of(places, others);
    const Solution solution = solve(normal_matrix(places, weights), prior_sd, turn_rad);
    others = solution.x;
    if (i < kIterations) {
      turn_rad += std::clamp(solution.x(0), -kStep_rad, kStep_rad);
      others(0) = 0.0;
      continue;
    }
    const double excess =
        std::max(1.0, solution.misfit / (static_cast<double>(places.size()) - kUnknowns));
    const double sd_rad = std::sqrt(excess * solution.covariance(0, 0));
    if (std::abs(solution.x(0)) > sd_rad) return std::nullopt;  // it has found no end
    SkylineHeading heading{-(turn_rad + solution.x(0)), sd_rad};
    // Of the two estimates whose mean the solution is, the prior's is zero.
    const double precision = 1.0 / solution.covariance(kUp, kUp) - 1.0 / std::pow(prior_sd(kUp), 2);
    heading.higher_m = solution.x(kUp) / (solution.covariance(kUp, kUp) * precision);
    heading.higher_sd_m = std::sqrt(excess / precision);
    return heading;
  }
}

}  // namespace ols::skyline
