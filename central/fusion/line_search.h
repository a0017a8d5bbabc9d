// How a station looks along another station's line of sight for a target without a position. Pure.
//
// A target is likeliest where the stations stand to see it: around the foot of their middle on the
// line. The stations that search share the line: each begins at another place, so that together
// they begin with equal parts of that probability, and sweeps from there outwards, away from the
// foot, then to and fro between the ends of the line. A sweep crosses a view in a time in which a
// target can be recognised, and begins when the unit has had time to come there.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "central/admission/station_registry.h"
#include "geometry/direction.h"

namespace ols::fusion {

// A ray with a target somewhere on it.
struct CueRay {
  std::string station;
  std::int64_t track_id = 0;  // the station's own
  std::int64_t utime_us = 0;
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
  Eigen::Vector3d rate_ecef = Eigen::Vector3d::Zero();  // [rad/s] of the direction
  double sd_rad = 0.0;                                  // of the direction, each axis

  CueRay at(std::int64_t later_us) const;
};

// Where on the line the target is thought to be.
struct LinePrior {
  double range_m = 300.0;  // most likely, from the line's origin
  double sd_m = 150.0;     // of a logistic distribution
};

// A searcher's share of the line.
struct LineShare {
  int rank = 0;  // 0 .. of - 1, from the near end to the far one
  int of = 1;    // searchers
};

struct LineSearchConfig {
  double near_m = 30.0;  // the ends of the line
  double far_m = 20e3;
  double view_s = 0.5;  // in which a sweep crosses the narrower field of view
  // Of the units, as the servo drives them; to foresee when one has come to its beginning.
  double acceleration_rad_s2 = 0.8, speed_rad_s = 1.0, settle_s = 0.3;
};

// Where a sweep begins, and which way it goes first.
struct SweepStart {
  double range_m = 0.0;
  bool outwards = true;  // towards the far end
};
SweepStart sweep_start(const LinePrior& prior, const LineShare& share,
                       const LineSearchConfig& config);

// How long a unit takes to turn by this angle.
double turning_s(double angle_rad, const LineSearchConfig& config);

// How far the sweep has come, in shares of 0 .. way_rad, and whether it goes up.
struct SweepPlace {
  double angle_rad = 0.0;
  bool up = true;
};
SweepPlace to_and_fro(double begin_rad, double swept_rad, double way_rad, bool up_first);

// What a station is to do at one instant.
struct LineLook {
  AzimuthElevation direction;                            // in the horizon at the camera centre
  Eigen::Vector2d rate_rad_s = Eigen::Vector2d::Zero();  // on the tangent plane
  Eigen::Vector2d line = Eigen::Vector2d::UnitX();       // which way the line runs there
  double sd_rad = 0.0;                                   // beside the line
};

// One station's sweep. The ray moves with its target.
class LineSweep {
 public:
  // `axis`: where the camera looks when the search begins, if that is known.
  LineSweep(const CueRay& ray, const StationTraits& station, const SweepStart& start,
            const LineSearchConfig& config);
  // searched_s after the search has begun.
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
