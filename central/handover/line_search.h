// Plans a station's search along another station's line of sight, for a target whose position is
// unknown. Pure.
//
// The target is most likely near the stations. The most likely range is therefore the range of the
// foot: the point of the line that is nearest to the centre of the stations
// (SlewSchedule::expect_range()). The target's apparent size or a cue may change the most likely
// range. The searching stations divide the line into parts of equal probability. Each station
// begins in its own part. It sweeps outwards first, away from the most likely range, then to and
// fro between the ends of the line. The sweep is slow enough for a tracker to recognise a target
// that crosses the field of view. The sweep begins when the unit has had time to turn to its start.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "central/admission/station_registry.h"
#include "geometry/direction.h"

namespace ols::fusion {

// A ray to a target at an unknown range.
struct CueRay {
  std::string station;
  std::int64_t track_id = 0;  // the station's own id
  std::int64_t utime_us = 0;
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
  Eigen::Vector3d rate_ecef = Eigen::Vector3d::Zero();  // [rad/s] rate of the direction
  double sd_rad = 0.0;                                  // 1-sigma of the direction, each axis
  double size_rad = 0.0, size_sd_rad = 0.0;             // apparent size of the target; 0: unknown

  CueRay at(std::int64_t later_us) const;
};

// The range at which the target is expected on the line.
struct LinePrior {
  double range_m = 300.0;  // most likely range, from the line's origin
  double sd_m = 150.0;     // 1-sigma of the range, which has a logistic distribution
};

// The range at which a drone or a bird of usual size has this apparent size. nullopt if the
// apparent size is unknown or too uncertain.
std::optional<LinePrior> range_by_size(const CueRay& ray);

// Combines two ranges by the weighted mean of their logarithms. If the sigma of `second` is at
// least as large as its range, the result is `first`.
LinePrior combined(const LinePrior& first, const LinePrior& second);

// The part of the line in which one searching station begins.
struct LineShare {
  int rank = 0;  // from 0 (at the near end) to `of` - 1 (at the far end)
  int of = 1;    // number of searching stations
};

struct LineSearchConfig {
  double near_m = 30.0;  // the ends of the line
  double far_m = 20e3;
  double view_s = 0.5;  // time in which a sweep crosses the narrower field of view
  // Performance of servo and pan-tilt unit. It predicts how long a unit needs to turn to the start
  // of its sweep.
  double acceleration_rad_s2 = 0.8, speed_rad_s = 1.0, settle_s = 0.3;
};

// The point at which a sweep begins, and its first direction.
struct SweepStart {
  double range_m = 0.0;
  bool outwards = true;  // towards the far end
};
SweepStart sweep_start(const LinePrior& prior, const LineShare& share,
                       const LineSearchConfig& config);

// How long a unit takes to turn by this angle, at rest before and after.
double turning_s(double angle_rad, const LineSearchConfig& config);

// The angle that a sweep has reached [rad], 0..way_rad, and whether the angle is increasing.
struct SweepPlace {
  double angle_rad = 0.0;
  bool up = true;
};
SweepPlace to_and_fro(double begin_rad, double swept_rad, double way_rad, bool up_first);

// The direction in which a station is to look at one instant.
struct LineLook {
  AzimuthElevation direction;  // relative to the horizon at the camera centre
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();  // on the tangent plane
  Eigen::Vector2d line = Eigen::Vector2d::UnitX();       // direction of the line there
  double sd_rad = 0.0;                                   // 1-sigma across the line
};

// One station's sweep along a ray. The ray moves with its target.
class LineSweep {
 public:
  // The sweep starts when the unit has had time to turn from the last known direction of `station`.
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
