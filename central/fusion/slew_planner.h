// Decides where each station is to point when the command takes effect. Pure.
//
//  - A station is led to the predicted position of the target to which it is allocated
//    (station_allocation.h). While it does not see that target, and the direction is less certain
//    than the field of view, the station searches along a spiral over the uncertainty, from the
//    inside outwards.
//  - If no position is known but one station sees an object, the others search along that
//    station's ray (line_search.h).
//  - An allowed cue from outside (central/cues/) is an additional place for stations that see
//    nothing. A station that would otherwise join a crowded target goes to the cue instead.
//  - A station that cannot be commanded (it is stopped, or under operator control) gets no slew,
//    because the operator has precedence over the fusion. The station itself would refuse the slew,
//    too.
//
// Commanded rates stay within the rate limit. A slew may jump to any new direction: the station
// turns there at its own maximum rate. Every slew contains its lease.
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
  double act_s = 0.1;         // time from the command to its effect: transport, servo cycle
  double lease_s = 0.5;       // the station halts after this time without a newer command
  double coast_s = 2.0;       // a target is predicted for this long after its last bearing
  double view_share = 0.5;    // step of a search, relative to the field of view
  double dwell_s = 0.4;       // time at each point
  double search_sigma = 2.5;  // radius of the spiral, in sigmas
  LineSearchConfig line{};    // for a search along a ray
};

struct Slew {
  std::string station;
  std::int64_t utime_us = 0;         // message time at creation
  std::int64_t effect_utime_us = 0;  // the instant for which the direction holds
  std::int64_t target_id = 0;        // 0 in a search along a ray
  AzimuthElevation direction;        // relative to the horizon at the camera centre
  double azimuth_rate_rad_s = 0.0;
  double elevation_rate_rad_s = 0.0;
  double direction_sd_rad = 0.0;
  // In a search along a ray: direction of the ray there.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
  double lease_s = 0.0;
  std::int64_t let_go_track_id = 0;  // what its tracker follows and lets go of; 0: nothing
};

// The slew that points a station's camera at a predicted state. Its uncertainty follows from the
// uncertainties of both positions. The caller sets station, times and target.
Slew slew_to(const KinematicState& target, const StationTraits& station, const SlewConfig& config);

// The k-th point (k >= 0) of a search, on an Archimedean spiral from the centre outwards, in units
// of a step. Each point is about one unit from the previous point and from the inner turn, and
// covers a unit area.
Eigen::Vector2d spiral_point(int k);

struct SlewStation {
  std::string station;
  StationTraits traits;
  std::int64_t follows = 0;          // the target that it sees; 0 if none
  bool stares = false;               // the station is never led
  std::int64_t let_go_track_id = 0;  // what its tracker follows and lets go of; 0: nothing
  bool is_led() const { return traits.commandable && !stares; }
};

// The data that all stations share at one instant.
struct SlewRound {
  std::int64_t now_us = 0;
  std::map<std::int64_t, int> seen_by{};  // number of stations that see each target
  // Priority of each target; 1 if absent; a target with 0 leads no station.
  std::map<std::int64_t, double> priority{};
  std::set<std::int64_t> wanted{};                // targets that an operator wants
  std::set<std::int64_t> targets{};               // targets to which stations may be led
  Allocation allocation{};                        // of the stations to the targets
  std::set<std::string> bearing_only_stations{};  // stations that have a bearing-only track
  std::set<std::string> busy{};               // those of them whose own tracker follows the object
  std::optional<CueRay> ray{};                // the ray along which stations search
  LinePrior prior{};                          // where on the ray the target is expected
  std::map<std::string, LineShare> shares{};  // shares of the stations that search along the ray
  std::vector<CueAim> cues{};                 // cues to which stations may be led
  std::string cue_on_ray{};                   // id of the cue near which the ray passes
  std::map<std::string, int> led_to{};        // number of stations led to each cue
};

// The newest of one station's bearings, of its detector or of its tracker; null if there is none
// within the last second.
const BearingMeasurement* newest_of(const std::vector<BearingMeasurement>& bearings,
                                    bool is_tracklet, std::int64_t now_us);
// The newest bearing of this target from the station's tracker; null if there is none within the
// last second.
const BearingMeasurement* tracker_of(const Track& track, const std::string& station,
                                     std::int64_t now_us);

class SlewPlanner {
 public:
  explicit SlewPlanner(const SlewConfig& config = {}) : config_(config) {}

  // Decides, for the round, to which target each station is led. Confirmed `tracks` count, and
  // coasting ones for coast_s.
  void allocate(SlewRound& round, std::span<const SlewStation> stations,
                const std::vector<Track>& tracks) const;
  // Plans for all or some of the stations, and counts in the round how many are sent to each
  // target.
  std::vector<Slew> plan(SlewRound& round, std::span<const SlewStation> stations,
                         const std::vector<Track>& tracks);
  void forget(const std::string& station) { searches_.erase(station); }
  void clear() { searches_.clear(); }

 private:
  struct Search {
    std::int64_t target_id = 0;  // the target to which the station is led
    std::string ray;  // without a target: the ray that is searched (STATION/TRACK), or a cue
    std::int64_t begun_us = 0;
    std::optional<LineSweep> sweep{};  // sweep along that ray
    std::optional<double> turn_s{};    // time that the unit needs to turn to a cue
    std::string cue{};                 // the id of that cue
    double searched_s(std::int64_t now_us) const;
  };
  std::vector<const Track*> targets_of(const SlewRound& round,
                                       const std::vector<Track>& tracks) const;
  const Track* target_for(SlewRound& round, const SlewStation& station,
                          const std::vector<const Track*>& targets);
  // Returns null if there is no cue for this station.
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
