// Where each station has to point at the instant at which it can act. Pure.
//
//  - A station that sees a target is led to where that will be.
//  - One that sees none is led to the target that the fewest see; while the direction is less sure
//    than its view is wide, along a spiral that covers the uncertainty, nearest first.
//  - Where no position is known, but one station has a target in view, the others search along that
//    station's ray, from near to far and back, in steps that overlap in their views.
//  - A station that cannot be commanded (an operator has it, it is stopped) gets nothing: the
//    operator comes before the fusion. The station itself refuses, too.
// Told rates stay within the rate limit (a new direction may be anywhere: the station turns there
// as fast as its own limits let it); every slew carries its lease.
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
  double act_s = 0.1;    // from the command to its effect: way, servo cycle
  double lease_s = 0.5;  // without a newer command the station halts
  double coast_s = 2.0;  // a target is predicted for so long after its last bearings
  // Of the direction that is asked for.
  double rate_limit_rad_s = kSlewRateLimit_rad_s;
  double view_share = 0.5;      // of the view, one step of a search
  double dwell_s = 0.4;         // at each step
  double search_sigma = 2.5;    // the spiral's reach
  double search_near_m = 30.0;  // along a ray, from here
  double search_far_m = 20e3;   // to here
};

struct Slew {
  std::string station;
  std::int64_t utime_us = 0;         // message time at which it was made
  std::int64_t effect_utime_us = 0;  // the instant at which the direction holds
  std::int64_t target_id = 0;        // 0: none, a search along a ray
  AzimuthElevation direction;        // in the horizon at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
  double lease_s = 0.0;
};

// Gives a predicted state's direction from a station's camera; how sure it is follows from how well
// both places are known. Station, times and target are left to the caller.
Slew slew_to(const KinematicState& target, const StationTraits& station, const SlewConfig& config);

// The k-th point (k >= 0) of a search: on the spiral of Archimedes from the centre outwards, about
// a unit from the one before and from the turn within; a unit area for each.
Eigen::Vector2d spiral_point(int k);

struct SlewStation {
  std::string station;
  StationTraits traits;
  std::int64_t follows = 0;  // the target that it sees; 0: none
};

// A ray with a target on it somewhere.
struct CueRay {
  std::string station;
  Eigen::Vector3d origin_ecef = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_ecef = Eigen::Vector3d::UnitX();
};

// What is the same for all stations at one instant.
struct SlewRound {
  std::int64_t now_us = 0;
  std::map<std::int64_t, int> seen_by{};          // how many stations see each target
  std::set<std::string> bearing_only_stations{};  // stations that follow what is no target
  std::optional<CueRay> ray{};                    // of one of them
};

class SlewPlanner {
 public:
  explicit SlewPlanner(const SlewConfig& config = {}) : config_(config) {}

  // Of some stations or all; who is sent to a target is counted in the round. `tracks` are taken
  // while confirmed, or coasted for coast_s.
  std::vector<Slew> plan(SlewRound& round, std::span<const SlewStation> stations,
                         const std::vector<Track>& tracks);
  void forget(const std::string& station) { searches_.erase(station); }
  void clear() { searches_.clear(); }

 private:
  struct Search {
    std::int64_t target_id = 0;  // that it is led to, or
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
