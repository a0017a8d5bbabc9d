// What the land hides from a camera: for each azimuth a staircase of (elevation, distance), the
// highest elevation of the land up to that distance.
//
// Angles are apparent: in the east-north-up frame at the camera (geometry/direction.h), lifted by
// terrestrial refraction, k d^2 / 2R. Points come from the surface's latitude, longitude and height
// by exact WGS84 geometry. `distance_m` is horizontal in that frame; ranges are straight lines.
//
// The land is sampled in cells as long as the columns are apart, and not shorter than
// `least_cell_m`; crests are refined within a cell. The staircase keeps distances to a quarter of a
// cell.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "land/refraction.h"
#include "land/staircase.h"
#include "land/surface.h"

namespace ols::land {

struct HorizonMapConfig {
  int columns = 7200;         // of azimuth: 0.05 degrees
  double reach_m = 30'000.0;  // horizontal
  double least_cell_m = 1.0;
  // Only these azimuths are looked at, as far as a mount turns; elsewhere no land is known.
  double from_azimuth_rad = 0.0;
  double sector_rad = 2.0 * kPi;  // clockwise
  double refraction_k = kRefraction;
  double refraction_k_sd = kRefractionSd;
};

// A highest elevation.
struct Skyline {
  double elevation_rad = 0.0;
  double elevation_sd_rad = 0.0;  // the surface's and refraction's, 1-sigma
  double distance_m = 0.0;        // of that crest, in the nearer of the two columns beside
};

// Where a line of sight first meets the land.
struct GroundHit {
  double range_m = 0.0;
  double elevation_sd_rad = 0.0;  // of the land there, 1-sigma
  // How the land rises with range there [rad/m]; 0 on a crest. The range's 1-sigma is that of the
  // elevations, land's and sight's, over this.
  double rise_rad_per_m = 0.0;
};

class HorizonMap {
 public:
  // `camera`: the camera's centre. Throws std::invalid_argument where the surface does not know the
  // ground at the camera, or has it above the camera by more than three of its sigmas.
  HorizonMap(const Surface& surface, const Geodetic& camera, const HorizonMapConfig& config = {});

  // Nothing where no land is known in that direction.
  std::optional<Skyline> skyline(double azimuth_rad) const;
  // Nothing above the skyline.
  std::optional<GroundHit> ground(const AzimuthElevation& sight) const;
  // The same of the land nearer than this.
  std::optional<Skyline> highest_before(double azimuth_rad, double distance_m) const;
  // The probability that the land does not hide a point: `covariance_ecef` [m^2] of the point,
  // sigma of the land. Land that is not known hides nothing.
  double visible_probability(const Eigen::Vector3d& p_ecef,
                             const Eigen::Matrix3d& covariance_ecef) const;

  // Beyond, the surface has a gap or ends [m, horizontal]; reach_m where it has none.
  double known_to_m(double azimuth_rad) const;
  // By so much the surface was lowered at the camera, because it had the camera less than
  // kLeastAboveGround_m above the ground: within its error [m].
  double lowered_m() const { return lowered_m_; }
  const Geodetic& camera() const { return frame_.origin(); }
  const HorizonMapConfig& config() const { return config_; }
  std::size_t step_count() const { return steps_.size(); }

  static constexpr double kLeastAboveGround_m = 1.0;

 private:
  struct Columns;  // the two beside an azimuth

  Columns beside(double azimuth_rad) const;
  void march_all(const Surface& surface, bool covered);
  double cell_m(double distance_m) const;
  double probability_at(const Columns& columns, double distance_m, double elevation_rad,
                        double elevation_sd_rad) const;

  LocalFrame frame_;
  HorizonMapConfig config_;
  double lowered_m_ = 0.0;
  std::vector<Step> steps_;          // of all columns, each ascending in both
  std::vector<std::size_t> begins_;  // of each column in steps_, and the end
  std::vector<float> known_to_m_;    // of each column
};

}  // namespace ols::land
