// Checks of a bearing that need no other data. Pure.
#pragma once

#include <string_view>

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// Why a bearing was not used; to_string() names its counter.
enum class BearingRefusal {
  kNone,
  kNotFinite,
  kOutOfRange,
  // Covariance out of range, white part ill-conditioned, or systematic part not semidefinite.
  kCovariance,
  kUnknown,  // the station does not belong to this site
  kStale,
  kFuture,
  kDuplicate,
  kQuarantine,  // the station's clock or pose is not credible
  kTooMany,     // more stations than max_stations
  kFlood,       // more bearings from one station than flood_hz allows
  kLowBelief,
  kCount,  // the number of reasons; not itself a reason
};
const char* to_string(BearingRefusal refusal);
// An explanation for a person: what is wrong, and where to look.
std::string_view in_words(BearingRefusal refusal);

// Whether a station can be at this position: the position is near the Earth's surface, and the
// standard deviation of the position is valid.
bool is_a_stations_place(const Eigen::Vector3d& p_ecef, const Eigen::Vector3d& sd_enu_m);

BearingRefusal check(const BearingMeasurement& measurement);

}  // namespace ols::fusion
