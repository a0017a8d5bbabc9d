// Where each station must point at the time when it can act. Pure.
//
//  - A station that sees a target is led to its predicted position.
//  - One that sees none is led to the target that the fewest stations see. While the direction is
//    less certain than its field of view, it searches along a spiral that covers the uncertainty,
//    nearest first.
//  - Where no position is known but one station has a target in view, the others search along that
//    station's ray, from near to far and back, in steps that overlap in their views.
//  - A station that cannot be commanded (operator control, or stopped) gets no slew: the operator
//    has precedence over the fusion. The station itself refuses, too.
// Commanded rates stay within the rate limit (a new direction may be anywhere: the station turns to
// it at its own maximum rate); every slew carries its lease.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "central/admission/station_registry.h"
#include "central/tracking/track.h"
#include "geometry/direction.h"
#include "geometry/slew_limits.h"

namespace ols::fusion {

struct SlewConfig {
  double rate_hz = 10.0;
  double act_s = 0.1;    // from the command to its effect: transport, servo cycle
  double lease_s = 0.5;  // without a newer command the station halts
  double coast_s = 2.0;  // a target is predicted for this long after its last bearings
  double rate_limit_rad_s = kSlewRateLimit_rad_s;
  double view_share = 0.5;      // step of a search, over the field of view
  double dwell_s = 0.4;         // at each step
  double search_sigma = 2.5;    // radius of the spiral
  double search_near_m = 30.0;  // start of a search along a ray
  double search_far_m = 20e3;   // its end
};

struct Slew {
  std::string station;
  std::int64_t utime_us = 0;         // message time at creation
  std::int64_t effect_utime_us = 0;  // the time for which the direction holds
  std::int64_t target_id = 0;        // 0: none, search along a ray
  AzimuthElevation direction;        // in the horizon at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
  double lease_s = 0.0;
};

// The direction to a predicted state from a station's camera; its uncertainty follows from those of
// both positions. The caller sets station, times and target.
Slew slew_to(const KinematicState& target, const StationTraits& station, const SlewConfig& config);

// The k-th point (k >= 0) of a search: on an Archimedean spiral from the centre outwards, about a
// unit from the point before and from the inner turn; a unit area for each.
Eigen::Vector2d spiral_point(int k);

struct SlewStation {
  std::string station;
  StationTraits traits;
  std::int64_t follows = 0;  // the target that it sees; 0: none
};

// A ray with a target somewhere on it.
struct CueRay {
  std::string station;
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
};

// The state common to all stations at one instant.
struct SlewRound {
  std::int64_t now_us = 0;
  std::map<std::int64_t, int> seen_by{};          // number of stations that see each target
  std::set<std::string> bearing_only_stations{};  // stations with a bearing-only track
  std::optional<CueRay> ray{};                    // one of their rays
};

class SlewPlanner {
 public:
  explicit SlewPlanner(const SlewConfig& config = {}) : config_(config) {}

  // Plans for some stations or all, and counts in the round those sent to each target. Of `tracks`,
  // confirmed ones count, and coasting ones for coast_s.
  std::vector<Slew> plan(SlewRound& round, std::span<const SlewStation> stations,
                         const std::vector<Track>& tracks);
  void forget(const std::string& station) { searches_.erase(station); }
  void clear() { searches_.clear(); }

 private:
  struct Search {
    std::int64_t target_id = 0;  // to which it is led, or
    std::string ray;             // the station whose ray it searches
    std::int64_t begun_us = 0;
  };
  const Track* target_for(const SlewStation& station, const std::vector<const Track*>& targets,
                          std::map<std::int64_t, int>& seen_by);
  std::int64_t effect_of(const StationTraits& station, std::int64_t now_us) const;
  Slew towards(const Track& track, const SlewStation& station, std::int64_t now_us);
  Slew along(const CueRay& ray, const SlewStation& station, std::int64_t now_us);
  double searched_s(const std::string& station, std::int64_t target_id, const std::string& ray,
                    std::int64_t now_us);

  SlewConfig config_;
  std::map<std::string, Search> searches_;
};

}  // namespace ols::fusion
