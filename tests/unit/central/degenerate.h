// Stations and targets in all degenerate geometries, with sizes and offsets that the test chooses.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "central/measurement/ray.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion::test {

struct DegenerateScene {
  std::string name;
  std::vector<Eigen::Vector3d> places_enu;  // [m]
  Eigen::Vector3d target_enu;               // [m]
  bool away = false;                        // the stations point in the opposite direction
};

// All kinds of geometry, each with every combination of a size of the site and an offset from the
// exactly degenerate case.
inline std::vector<DegenerateScene> degenerate_scenes(const std::vector<double>& sizes_m,
                                                      const std::vector<double>& offsets_m) {
  using Eigen::Vector3d;
  std::vector<DegenerateScene> scenes;
  for (const double size : sizes_m) {
    for (const double off : offsets_m) {
      const auto add = [&](const std::string& kind, const std::vector<Vector3d>& places,
                           const Vector3d& target, bool away = false) {
        scenes.push_back({kind + ", size " + std::to_string(size) + " m, offset 1e" +
                              std::to_string(off > 0.0 ? std::log10(off) : -99.0) + " m",
                          places, target, away});
      };
      const Vector3d a(0, 0, 0), b(size, 0, 0), c(2.3 * size, 0, 0);
      const Vector3d aside(0, off, 0.7 * off), up(0, 0, off);
      for (const double along : {0.1, 0.5, 0.9}) {
        add("between two", {a, b}, along * b + aside);
        add("between two, above", {a, b}, along * b + up);
      }
      add("on the line beyond two", {a, b}, 1.7 * b + aside);
      add("collinear with three, between", {a, b, c}, 0.4 * b + aside);
      add("collinear with three, beyond", {a, b, c}, 1.5 * c + up);
      add("three in line, the target beside", {a, b, c}, {0.5 * size, 0.8 * size, off});
      add("two at one place", {a, aside}, {0.3 * size, size, 0.1 * size});
      add("three at one place", {a, aside, up}, {0.3 * size, size, 0.1 * size});
      add("two at one place and one elsewhere", {a, aside, b}, {0.3 * size, size, 0.1 * size});
      add("at a station", {a, b}, aside);
      add("at a station, of three", {a, b, {0, size, 0}}, up);
      add("behind both", {a, b}, {0.4 * size, size, off}, true);
      add("nearly parallel", {a, {off, 0, 0}}, {0, size, 0});
      add("nearly parallel, three", {a, {off, 0, 0}, up}, {0.1 * size, size, 0});
    }
  }
  return scenes;
}

// The rays of a scene. If `random` is not null, each ray is turned by random angles with this
// sigma.
inline std::vector<Ray> rays_of(const DegenerateScene& scene, double sigma_rad,
                                std::mt19937_64* random) {
  std::vector<Ray> rays;
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < scene.places_enu.size(); ++i) {
    const Eigen::Vector3d& place = scene.places_enu[i];
    Eigen::Vector3d at = scene.target_enu;
    if (scene.away) at = 2.0 * place - at;
    if ((at - place).norm() == 0.0) at += Eigen::Vector3d(0, 1, 0);  // any direction
    Ray ray = ray_to(std::string(1, static_cast<char>('a' + i)), place, at, sigma_rad);
    if (random != nullptr) {
      const double x = sigma_rad * normal(*random), y = sigma_rad * normal(*random);
      ray = turned(ray, x, y);
    }
    rays.push_back(ray);
  }
  return rays;
}

inline bool is_positive_definite(const Eigen::Matrix3d& P) {
  return P.allFinite() && Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(P, Eigen::EigenvaluesOnly)
                                  .eigenvalues()(0) > 0.0;
}

// What is inconsistent in an estimate; empty: nothing.
inline std::string false_claim(const Estimate& estimate) {
  if (estimate.solution != Solution::kOk) {
    return estimate.position_ecef.allFinite() ? "a position without a solution" : "";
  }
  if (!estimate.position_ecef.allFinite()) return "no position";
  if (!is_positive_definite(estimate.covariance_ecef)) return "its covariance is none";
  const Eigen::Matrix3d& white = estimate.covariance_white_ecef;
  const double least = -1e-12 * white.cwiseAbs().maxCoeff();
  if (!white.allFinite() ||
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(white, Eigen::EigenvaluesOnly)
              .eigenvalues()(0) < least) {
    return "the white part of its covariance is none";
  }
  if (estimate.velocity_ecef.allFinite() &&
      !is_positive_definite(estimate.velocity_covariance_ecef)) {
    return "the covariance of its velocity is none";
  }
  return "";
}

}  // namespace ols::fusion::test
