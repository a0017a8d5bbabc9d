#include "edge/skyline/skyline_heading.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "edge/skyline/modelled_crest.h"
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

std::optional<Place> place_of(const SeenPlace& seen, const land::HorizonMap& map, double turn_rad) {
  const double azimuth_rad = seen.direction.azimuth_rad + turn_rad;
  const auto crest = crest_at(map, azimuth_rad);
  if (!crest) return std::nullopt;
  Place place;
  place.row << crest->slope, 1.0, std::sin(azimuth_rad), std::cos(azimuth_rad), crest->by_place,
      crest->by_refraction, seen.direction.elevation_rad - crest->elevation_rad;
  place.crest_m = crest->place_m;
  place.model_sd_rad = crest->model_sd_rad;
  place.white_rad2 = seen.variance_rad2 + crest->rough_rad2;
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
