// The true land around a simulated site: hills, the roughness of the ground, houses and trees.
// Written without the product's code; the product has at most a model of this land (land_model.h).
// Pure.
//
// Places are metres east and north in the site's frame. Heights are ellipsoidal heights minus the
// height of the site's origin: level ground has height 0 everywhere.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace ols::sim {

struct Hill {  // a Gaussian
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double height_m = 30.0;
  Eigen::Vector2d width_m{60.0, 60.0};  // 1-sigma along the heading and across it
  double heading_rad = 0.0;
};

struct House {  // with a level roof; heights count from the lowest ground at its corners
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  Eigen::Vector3d size_m{12.0, 8.0, 6.0};  // along the heading, across it, height
  double heading_rad = 0.0;
  bool mapped = true;  // whether the product's model has it

  Eigen::Vector2d corner_m(int index) const;  // `index`: 0 to 3, in order around the house
  bool covers(const Eigen::Vector2d& place_m) const;
};

struct Tree {  // a cylinder; the product's model has no trees
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double height_m = 8.0, radius_m = 2.0;
};

// The resolution and the errors of the product's model of the land.
struct LandModelScenario {
  double reach_m = 1500.0;    // of the grid, in each direction from the origin
  double spacing_m = 10.0;    // of the grid's heights
  double sd_m = 1.0;          // 1-sigma of the errors of the heights
  double length_m = 80.0;     // these errors are correlated over about this distance
  double house_sd_m = 0.5;    // 1-sigma of the houses' heights
  double outline_sd_m = 1.0;  // 1-sigma of the houses' positions, each axis
};

struct ReliefScenario {
  double roughness_m = 0.2, roughness_length_m = 15.0;  // 1-sigma, and wavelength
  std::vector<Hill> hills;
  std::vector<House> houses;
  std::vector<Tree> trees;
  LandModelScenario model;

  bool is_flat() const { return hills.empty() && houses.empty() && trees.empty(); }
};

// A random field with this 1-sigma; its wavelengths are about `length_m`.
class Waves {
 public:
  Waves(double sd_m, double length_m, std::uint64_t seed);
  double at(const Eigen::Vector2d& place_m) const;

 private:
  static constexpr int kWaves = 16;
  double amplitude_m_;
  Eigen::Matrix<double, kWaves, 2> wave_rad_m_;
  Eigen::Matrix<double, kWaves, 1> phase_rad_;
};

// A random field with this 1-sigma: the errors of an elevation model. The correlation of two points
// is exp(-distance / length_m); the field has waves of all lengths.
class ErrorField {
 public:
  ErrorField(double sd_m, double length_m, std::uint64_t seed);
  double at(const Eigen::Vector2d& place_m) const;

 private:
  static constexpr int kWaves = 64;
  float amplitude_m_;
  Eigen::Array<float, kWaves, 2> wave_rad_m_;
  Eigen::Array<float, kWaves, 1> phase_rad_;
};

class Relief {
 public:
  explicit Relief(const ReliefScenario& scenario);

  double ground_m(const Eigen::Vector2d& place_m) const;
  double top_m(const Eigen::Vector2d& place_m) const;
  // The tangent of the land's highest elevation, seen from a camera in a horizontal direction.
  // `camera_enu`: in the site's frame. `outward`: the direction, a unit vector. `distance_m`: only
  // land up to this distance counts, and never land beyond 10 km.
  double highest_slope(const Eigen::Vector3d& camera_enu, const Eigen::Vector2d& outward,
                       double distance_m) const;
  // Whether the land hides the target from the camera.
  bool hides(const Eigen::Vector3d& camera_enu, const Eigen::Vector3d& target_enu) const;

 private:
  ReliefScenario scenario_;
  Waves roughness_;
  std::vector<double> roofs_m_;  // of the houses
};

}  // namespace ols::sim
