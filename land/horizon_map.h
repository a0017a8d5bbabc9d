// What the land hides from a camera: for each azimuth a staircase of (elevation, distance). The
// elevation is the highest elevation of the land up to that distance.
//
// Elevations are apparent: the elevation in the east-north-up frame at the camera
// (geometry/direction.h), raised by terrestrial refraction. Refraction lifts a point at distance d
// by k d^2 / 2R (land/refraction.h). Points of the surface are converted by exact WGS84 geometry. A
// distance is horizontal in that frame; a range is measured along the straight line.
//
// A column is one azimuth. The land is sampled along each column in cells. A cell is as long as the
// distance between neighbouring columns, and at least `least_cell_m`; crests are refined within a
// cell. Distances in the staircase are accurate to a quarter of a cell.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/angles.h"
#include "geometry/direction.h"
#include "geometry/wgs84.h"
#include "land/refraction.h"
#include "land/staircases.h"
#include "land/surface.h"

namespace ols::land {

struct HorizonMapConfig {
  int columns = 7200;         // number of azimuths; 7200 are 0.05 degrees apart
  double reach_m = 30'000.0;  // horizontal distance at which the map ends
  double least_cell_m = 1.0;
  // Only azimuths in this sector are computed, for example the range of a mount's pan axis. In
  // other directions the land is unknown.
  double from_azimuth_rad = 0.0;
  double sector_rad = 2.0 * kPi;  // clockwise
  double refraction_k = kRefraction;
  double refraction_k_sd = kRefractionSd;
};

// The highest elevation of the land along an azimuth.
struct Skyline {
  double elevation_rad = 0.0;
  double elevation_sd_rad = 0.0;  // 1-sigma, from the surface and the refraction
  double distance_m = 0.0;        // distance of the crest, in the nearer of the two neighbouring
                                  // columns
};

// Where a line of sight first meets the land.
struct GroundHit {
  double range_m = 0.0;
  double elevation_sd_rad = 0.0;  // 1-sigma of the land there
  // How fast the land's elevation grows with range there [rad/m]; 0 on a crest. To get the 1-sigma
  // of the range, combine the 1-sigmas of both elevations (land and line of sight), and divide by
  // this.
  double rise_rad_per_m = 0.0;
};

class HorizonMap {
 public:
  // `camera`: the camera's centre. Throws std::invalid_argument if the ground at the camera is
  // unknown, or lies above the camera by more than three of its sigmas.
  HorizonMap(const Surface& surface, const Geodetic& camera, const HorizonMapConfig& config = {});

  // nullopt if the land in that direction is unknown.
  std::optional<Skyline> skyline(double azimuth_rad) const;
  // Where the line of sight meets the land. nullopt if it passes above the skyline, or if the land
  // in that direction is unknown.
  std::optional<GroundHit> ground(const AzimuthElevation& sight) const;
  // Like skyline(), but only for land nearer than `distance_m`.
  std::optional<Skyline> highest_before(double azimuth_rad, double distance_m) const;
  // The probability that the land does not hide a point. `covariance_ecef` [m^2] is the point's
  // covariance; the land's own error is taken into account as well. Unknown land hides nothing.
  double visible_probability(const Eigen::Vector3d& p_ecef,
                             const Eigen::Matrix3d& covariance_ecef) const;

  // The horizontal distance [m] up to which the surface is known without interruption; reach_m if
  // it is known all the way; 0 outside the sector.
  double known_to_m(double azimuth_rad) const;
  // The amount by which the surface was lowered at the camera [m]. The surface is lowered if the
  // camera would otherwise be less than kLeastAboveGround_m above the ground. An error of the
  // surface or of the camera's height can cause this.
  double lowered_m() const { return lowered_m_; }
  const Geodetic& camera() const { return frame_.origin(); }
  const HorizonMapConfig& config() const { return config_; }
  std::size_t step_count() const { return columns_.step_count(); }

  static constexpr double kLeastAboveGround_m = 1.0;

 private:
  struct Columns;  // the two columns next to an azimuth
  struct OnAzimuth;

  Columns beside(double azimuth_rad) const;
  void march_all(const Surface& surface, bool covered);
  double cell_m(double distance_m) const;
  static double sum_visible(const Columns& columns, const OnAzimuth& point,
                            std::span<const double> offsets);

  LocalFrame frame_;
  HorizonMapConfig config_;
  double columns_per_rad_;
  double lowered_m_ = 0.0;
  Staircases columns_;
  std::vector<float> known_to_m_;  // by column
};

}  // namespace ols::land
