// One object that the tracker follows: its filter, its bearings, and where it is in its life.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "central/filter/track_filter.h"
#include "central/measurement/ray.h"
#include "central/measurement/sighting.h"

namespace ols {

// The rules by which a track goes from one to the next are in docs/fusion.md and in
// central/tracking/track_keeper.h.
enum class TrackState { kBorn, kConfirmed, kCoasted, kDropped };
const char* to_string(TrackState state);

using StationBearings = std::map<std::string, std::vector<Sighting>>;  // each in order of time

struct Track {
  explicit Track(TrackFilter start) : filter(std::move(start)) {}

  TrackFilter filter;
  std::int64_t id = 0;  // 0 until it is confirmed
  TrackState state = TrackState::kBorn;
  std::int64_t born_us = 0;
  std::map<std::string, int> hits;  // bearings used, by station
  int misses = 0;                   // bearings set aside
  std::int64_t located_us = 0;      // when two stations had seen it lately, last
  StationBearings bearings;         // of the last second

  // Has it a bearing of this station and exposure already?
  bool has_taken(const Sighting& sighting) const;
};

// Confirmed or coasted.
bool is_sure(const Track& track);

// With two stations alone one residual has nothing to be checked against: whatever makes their rays
// miss, two objects as well as a wrong heading, is learnt as bias. Whether that is more than what
// they state allows.
bool are_made_to_meet(const TrackFilter& filter);

// Of a station that delivers, and that no two others have outvoted since its last used bearing: how
// many in a row are set aside, at most. It follows something else, or the target has turned as
// nobody thought; from kPartedBearings on there is no position, because nobody tells which.
int set_aside_in_a_row(const TrackFilter& filter, std::int64_t now_us);
inline constexpr int kPartedBearings = 6;

// Whether the greatest 1-sigma of the position is below this share of the nearest station's range.
bool has_range(const TrackFilter& filter, const KinematicState& state, double share);

// What a filter's state is worth as a position: kOk, or the named reason why it is none.
Solution judge_position(const TrackFilter& filter, const KinematicState& state);

// Stations whose bearings the filter has used within so long of its own time.
int stations_lately(const TrackFilter& filter, double within_s);

}  // namespace ols
