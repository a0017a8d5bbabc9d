// Decides where each station is to point when the command takes effect. Pure.
//
//  - A station is led to the predicted position of the target to which it is allocated
//    (station_allocation.h). If it does not see that target, and the error of the predicted
//    direction may exceed the field of view, the station searches on a spiral over the uncertain
//    region, from the inside outwards.
//  - If one station sees an object whose position is unknown, other stations search along that
//    station's ray (line_search.h).
//  - An allowed cue from outside (central/cues/) is an additional place for stations that see
//    nothing. A station that would be the third one at a target goes to the cue instead, until two
//    stations are led to the cue.
//  - A station that is stopped or under operator control gets no slew, because the operator has
//    precedence over the fusion. The station itself would refuse the slew, too.
//
// Commanded rates stay within the rate limit. The direction of a slew may differ from that of the
// last slew by any angle: the station turns there at its own maximum rate. Every slew contains its
// lease.
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
#include "central/cues/cue.h"
#include "central/handover/line_search.h"
#include "central/handover/station_allocation.h"
#include "central/tracking/track.h"
#include "geometry/direction.h"
#include "geometry/slew_limits.h"

namespace ols::fusion {

struct SlewConfig {
  double rate_hz = 10.0;
  double act_s = 0.1;         // from the command to its effect: transport, servo cycle
  double lease_s = 0.5;       // the station halts after this time without a newer command
  double coast_s = 2.0;       // a target is predicted for this long after its last bearing
  double view_share = 0.5;    // step of a search, relative to the field of view
  double dwell_s = 0.4;       // how long a search stays at each of its points
  double search_sigma = 2.5;  // radius of the spiral, in sigmas
  LineSearchConfig line{};    // for a search along a ray
};

struct Slew {
  std::string station;
  std::int64_t utime_us = 0;         // message time at creation
  std::int64_t effect_utime_us = 0;  // the instant for which the direction holds
  std::int64_t target_id = 0;        // 0 if the station is led along a ray or to a cue
  AzimuthElevation direction;        // relative to the horizon at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;  // 1-sigma, each axis; in a search along a ray: across the ray
  // In a search along a ray: the unit vector of the ray on the tangent plane. A vector that is not
  // zero makes the station look for an object that moves steadily, in any direction. It is
  // therefore also set, to (1, 0), if the station is to recognise a cue's object by its motion.
  // Zero in all other cases.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  double lease_s = 0.0;
  std::int64_t let_go_track_id = 0;  // the local track that its tracker is to let go of; 0: none
};

// The slew that points a station's camera at a target's predicted state. The slew's uncertainty
// combines the uncertainty of the target's position with that of the station's position. The caller
// sets the station, the times and the target.
Slew slew_to(const KinematicState& target, const StationTraits& station, const SlewConfig& config);

// The k-th point (k >= 0) of a search, on an Archimedean spiral from the centre outwards, in units
// of a step. Each point is about one unit from the previous point and from the next inner turn of
// the spiral. Each point covers a unit area.
Eigen::Vector2d spiral_point(int k);

struct SlewStation {
  std::string station;
  StationTraits traits;
  std::int64_t follows = 0;          // the target that it sees; 0 if none
  bool stares = false;               // by configuration, the station is never led
  std::int64_t let_go_track_id = 0;  // the local track that its tracker is to let go of; 0: none
  bool is_led() const { return traits.commandable && !stares; }
};

// The data that all stations share at one instant.
struct SlewRound {
  std::int64_t now_us = 0;
  // Number of stations that see each target, or that plan() begins to lead to it.
  std::map<std::int64_t, int> seen_by{};
  // Priority by target id. A target that is not in this map has priority 1. A target with priority
  // 0 leads no station.
  std::map<std::int64_t, double> priority{};
  std::set<std::int64_t> wanted{};                // targets that an operator wants
  std::set<std::int64_t> targets{};               // targets to which stations may be led
  Allocation allocation{};                        // which station goes to which target
  std::set<std::string> bearing_only_stations{};  // stations that have a bearing-only track
  std::set<std::string> busy{};                   // those of them whose tracker follows the object
  std::optional<CueRay> ray{};                    // the ray along which stations search
  LinePrior prior{};                              // the range at which the target is expected
  std::map<std::string, LineShare> shares{};  // shares of the stations that search along the ray
  std::vector<CueAim> cues{};                 // cues to which stations may be led
  std::string cue_on_ray{};                   // id of the cue near which the ray passes
  std::map<std::string, int> led_to{};        // number of stations led to each cue
};

// The newest bearing of this target from one station's detector (is_tracklet) or from its tracker;
// null if there is none within the last second. `bearings`: the track's bearings of the station.
const BearingMeasurement* newest_of(const Track& track,
                                    const std::vector<BearingMeasurement>& bearings,
                                    bool is_tracklet, std::int64_t now_us);
// The newest bearing of this target from the station's tracker; null if there is none within the
// last second.
const BearingMeasurement* tracker_of(const Track& track, const std::string& station,
                                     std::int64_t now_us);

class SlewPlanner {
 public:
  explicit SlewPlanner(const SlewConfig& config = {}) : config_(config) {}

  // Decides to which target each station is led in this round. Stations may be led to confirmed
  // tracks, and to tracks that have coasted for at most coast_s.
  void allocate(SlewRound& round, std::span<const SlewStation> stations,
                const std::vector<Track>& tracks) const;
  // Plans the slews of these stations (all, or a part of them). Adds the stations that it begins to
  // lead to a target to round.seen_by, and counts the stations led to each cue in round.led_to.
  std::vector<Slew> plan(SlewRound& round, std::span<const SlewStation> stations,
                         const std::vector<Track>& tracks);
  void forget(const std::string& station) { searches_.erase(station); }
  void clear() { searches_.clear(); }

 private:
  struct Search {
    std::int64_t target_id = 0;  // the target to which the station is led
    std::string ray;             // without a target: the searched ray (STATION/TRACK) or cue
    std::int64_t begun_us = 0;
    std::optional<LineSweep> sweep{};  // the sweep along that ray
    std::optional<double> turn_s{};    // time that the unit needs to turn to a cue
    std::string cue{};                 // the id of that cue
    double searched_s(std::int64_t now_us) const;
  };
  std::vector<const Track*> targets_of(const SlewRound& round,
                                       const std::vector<Track>& tracks) const;
  const Track* target_for(SlewRound& round, const SlewStation& station,
                          const std::vector<const Track*>& targets);
  // The cue to which the station is led; null if there is none.
  const CueAim* cue_for(const SlewRound& round, const SlewStation& station, const Track* target);
  void count_searches(SlewRound& round);
  std::int64_t effect_of(const StationTraits& station, std::int64_t now_us) const;
  Slew towards(const Track& track, const SlewStation& station, std::int64_t now_us);
  Slew towards(const CueAim& cue, const SlewStation& station, std::int64_t now_us);
  Slew along(const SlewRound& round, const SlewStation& station, const std::string& search_key);
  bool is_by_motion(const CueAim& cue, const SlewStation& station, std::int64_t now_us) const;
  bool is_wide(const CueAim& cue, const SlewStation& station, std::int64_t now_us) const;
  Slew stay(const SlewStation& station, std::int64_t now_us) const;
  std::optional<Slew> slew_of(SlewRound& round, const SlewStation& station,
                              const std::vector<const Track*>& targets);
  // Moves the slew's direction to the current point of its search.
  void search_around(Slew& slew, const SlewStation& station, double searched_s) const;
  Search& search_of(const std::string& station, std::int64_t target_id, const std::string& ray,
                    std::int64_t now_us);

  SlewConfig config_;
  std::map<std::string, Search> searches_;
};

}  // namespace ols::fusion
