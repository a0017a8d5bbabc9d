// A track: the filter, the bearings and the life-cycle state of one object.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "central/classify/class_posterior.h"
#include "central/filter/track_filter.h"
#include "central/measurement/bearing_measurement.h"
#include "central/measurement/ray.h"
#include "central/measurement/time_span.h"
#include "central/tracking/existence.h"

namespace ols::fusion {

// The transitions are in docs/fusion.md and central/tracking/track_manager.h.
enum class TrackState { kTentative, kConfirmed, kCoasting, kDeleted };

using StationBearings =
    std::map<std::string, std::vector<BearingMeasurement>>;  // each station's in order of time

// When a track last took a bearing of each kind, from any station; 0: never. Where a kind is
// absent, nobody has to search for it through all bearings, which lie far apart in memory.
struct LastOfKind {
  std::int64_t tracklet_us = 0, tracker_us = 0, appearance_us = 0;

  void note(const BearingMeasurement& measurement);
};

struct Track {
  explicit Track(TrackFilter start) : filter(std::move(start)) {}

  TrackFilter filter;
  std::int64_t id = 0;  // 0 until it is confirmed
  TrackState state = TrackState::kTentative;
  std::int64_t initiated_us = 0;
  std::map<std::string, int> hits;       // number of used bearings, by station
  int misses = 0;                        // number of rejected bearings
  std::int64_t last_two_station_us = 0;  // when two stations last saw it
  StationBearings bearings;              // those of the last second
  LastOfKind last;                       // noted with each of the bearings
  Existence existence;
  ClassPosterior classes;
  std::map<std::int64_t, Eigen::Vector3d>
      velocities;  // [m/s] ECEF, by the time of each look_at_class() of the last second

  // Whether the track already has a bearing from the same exposure of the same station.
  bool has_taken(const BearingMeasurement& measurement,
                 std::int64_t within_us = kExposure_us) const;
};

// Whether the track is confirmed or coasting.
bool is_established(const Track& track);

}  // namespace ols::fusion
