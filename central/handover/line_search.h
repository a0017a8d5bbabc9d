// Plans a station's search along another station's line of sight, for a target without a position.
// Pure.
//
// The target is most likely near the stations. The search is therefore centred on the foot, the
// point of the line nearest to their centre. The searching stations divide the line among them,
// into parts of equal probability. Each station begins in its own part. From there it sweeps
// outwards, away from the foot, then to and fro between the ends of the line. The sweep is slow
// enough that a target can be recognised while it crosses the field of view. It begins when the
// unit has had time to reach the start.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "central/admission/station_registry.h"
#include "geometry/direction.h"

namespace ols::fusion {

// A ray on which there is a target at an unknown range.
struct CueRay {
  std::string station;
  std::int64_t track_id = 0;  // the station's own id
  std::int64_t utime_us = 0;
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
  Eigen::Vector3d rate_ecef = Eigen::Vector3d::Zero();  // [rad/s] rate of the direction
  double sd_rad = 0.0;                                  // 1-sigma of the direction, each axis
  double size_rad = 0.0, size_sd_rad = 0.0;             // of the target; 0: unknown

  CueRay at(std::int64_t later_us) const;
};

// The range at which the target is expected on the line.
struct LinePrior {
  double range_m = 300.0;  // most likely range, from the line's origin
  double sd_m = 150.0;     // of a logistic distribution
};

// The range that follows from the apparent size of an object as large as a drone or a bird. nullopt
// if the size is unknown.
std::optional<LinePrior> range_by_size(const CueRay& ray);

// Combines both ranges, by their logarithms. If the sigma of `second` is as large as its range,
// `second` says nothing, and the result is `first`.
LinePrior combined(const LinePrior& first, const LinePrior& second);

// The part of the line with which one searching station begins.
struct LineShare {
  int rank = 0;  // 0 to of - 1, from the near end to the far end
  int of = 1;    // number of searching stations
};

struct LineSearchConfig {
  double near_m = 30.0;  // the ends of the line
  double far_m = 20e3;
  double view_s = 0.5;  // time in which a sweep crosses the narrower field of view
  // Performance of servo and pan-tilt unit, to predict when a unit has reached its start.
  double acceleration_rad_s2 = 0.8, speed_rad_s = 1.0, settle_s = 0.3;
};

// The point at which a sweep begins, and its first direction.
struct SweepStart {
  double range_m = 0.0;
  bool outwards = true;  // towards the far end
};
SweepStart sweep_start(const LinePrior& prior, const LineShare& share,
                       const LineSearchConfig& config);

// How long a unit takes to turn by this angle.
double turning_s(double angle_rad, const LineSearchConfig& config);

// The position reached in a sweep [rad], 0..way_rad, and whether it moves towards way_rad.
struct SweepPlace {
  double angle_rad = 0.0;
  bool up = true;
};
SweepPlace to_and_fro(double begin_rad, double swept_rad, double way_rad, bool up_first);

// Where a station is to look at one instant.
struct LineLook {
  AzimuthElevation direction;  // relative to the horizon at the camera centre
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();  // on the tangent plane
  Eigen::Vector2d line = Eigen::Vector2d::UnitX();       // direction of the line there
  double sd_rad = 0.0;                                   // across the line
};

// One station's sweep along a ray, which moves with its target.
class LineSweep {
 public:
  // The sweep starts after the unit had time to turn from `station`'s last known axis.
  LineSweep(const CueRay& ray, const StationTraits& station, const SweepStart& start,
            const LineSearchConfig& config);
  // `searched_s`: time since the beginning of the search.
  LineLook look(const CueRay& ray, const StationTraits& station, double searched_s) const;

 private:
  struct Plane;
  Eigen::Vector3d line_at(const Plane& plane, double searched_s) const;
  SweepPlace place(const Plane& plane, double searched_s) const;

  LineSearchConfig config_;
  SweepStart start_;
  double rate_rad_s_;
  double wait_s_;
};

}  // namespace ols::fusion
