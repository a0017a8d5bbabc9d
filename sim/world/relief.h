// The land around a simulated site as it truly is: hills, the roughness of the ground, houses and
// trees. Its own; the product knows at most a model of it (land_model.h). Pure.
//
// Places are metres east and north in the site's frame. Heights are above the site's origin, along
// the ellipsoid: level ground has height 0 everywhere.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace ols::sim {

struct Hill {  // a Gaussian
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double height_m = 30.0;
  Eigen::Vector2d width_m{60.0, 60.0};  // 1-sigma along its heading and across
  double heading_rad = 0.0;
};

struct House {  // with a level roof, above the lowest ground at its corners
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  Eigen::Vector3d size_m{12.0, 8.0, 6.0};  // along its heading, across, high
  double heading_rad = 0.0;
  bool mapped = true;  // the model has it

  Eigen::Vector2d corner_m(int index) const;  // 0 to 3, around
  bool covers(const Eigen::Vector2d& place_m) const;
};

struct Tree {  // a cylinder; no model has it
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double height_m = 8.0, radius_m = 2.0;
};

// What a survey made of it.
struct LandModelScenario {
  double reach_m = 1500.0;    // of the grid, each way
  double spacing_m = 10.0;    // of its heights
  double sd_m = 1.0;          // of its heights, 1-sigma;
  double length_m = 80.0;     // errors are alike over about this distance
  double house_sd_m = 0.5;    // of the houses' heights
  double outline_sd_m = 1.0;  // of the houses' places, each axis
};

struct ReliefScenario {
  double roughness_m = 0.2, roughness_length_m = 15.0;  // 1-sigma; wavelength
  std::vector<Hill> hills;
  std::vector<House> houses;
  std::vector<Tree> trees;
  LandModelScenario model;

  bool is_flat() const { return hills.empty() && houses.empty() && trees.empty(); }
};

// A random field with this 1-sigma, whose waves are about this long.
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

// A random field with this 1-sigma, whose correlation over a distance is exp(-distance / length_m):
// the errors of an elevation model. It has waves of all lengths.
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
  // The greatest tangent of the elevation of the land, seen from a camera (east, north, up in the
  // site's frame) in the direction of `outward` (a unit vector) up to a distance, at most 10 km.
  double highest_slope(const Eigen::Vector3d& camera_enu, const Eigen::Vector2d& outward,
                       double distance_m) const;
  // Whether it stands between the two.
  bool hides(const Eigen::Vector3d& camera_enu, const Eigen::Vector3d& target_enu) const;

 private:
  ReliefScenario scenario_;
  Waves roughness_;
  std::vector<double> roofs_m_;  // of the houses
};

}  // namespace ols::sim
