// Decides whether stations of this site can be led to a cue. Pure.
#pragma once

#include <cstdint>

#include "central/admission/station_registry.h"
#include "central/cues/cue.h"

namespace ols::fusion {

inline constexpr std::int64_t kGreatestUtime = 4'000'000'000'000'000;  // the year 2096

// Why a cue was refused; to_string() names its counter.
enum class CueRefusal {
  kNone,
  kNotFinite,
  kOutOfRange,  // impossible latitude, speed, deviation or time
  kPole,        // east and north are undefined there
  kStale,
  kFuture,
  kVague,
  kOutOfArea,
  kTooMany,
  kCount,  // the number of reasons; not itself a reason
};
const char* to_string(CueRefusal refusal);

// The checks that need only the cue and the present time.
CueRefusal check(const Cue& cue, std::int64_t present_us, const CueConfig& config);

// Whether any station is within range.
bool is_in_area(const Cue& cue, const StationRegistry& stations, double range_m);

}  // namespace ols::fusion
