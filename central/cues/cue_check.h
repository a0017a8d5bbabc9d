// Whether a cue is one that stations of this site can be led to. Pure.
#pragma once

#include <cstdint>

#include "central/admission/station_registry.h"
#include "central/cues/cue.h"

namespace ols::fusion {

inline constexpr std::int64_t kGreatestUtime = 4'000'000'000'000'000;  // the year 2096

// Why a cue was not taken; to_string() names its counter.
enum class CueRefusal {
  kNone,
  kNotFinite,
  kOutOfRange,  // a latitude, a speed, a deviation, a time that cannot be
  kPole,        // there east and north mean nothing
  kStale,
  kFuture,
  kVague,
  kOutOfArea,
  kTooMany,
  kCount,  // not a reason: how many there are
};
const char* to_string(CueRefusal refusal);

// The checks that need only the cue itself and the present.
CueRefusal check(const Cue& cue, std::int64_t present_us, const CueConfig& config);

// Whether a station stands near enough.
bool is_in_area(const Cue& cue, const StationRegistry& stations, double range_m);

}  // namespace ols::fusion
