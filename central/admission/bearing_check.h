// Which bearings are fit for use, as far as each can be judged by itself. Pure.
#pragma once

#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

// Why a bearing was not used; to_string() is the name of its counter.
enum class BearingRefusal {
  kNone,
  kNotFinite,
  kOutOfRange,
  kCovariance,  // out of range, or white not well conditioned, or systematic not semidefinite
  kUnknown,     // a station that does not belong to the site
  kStale,
  kFuture,
  kDuplicate,
  kQuarantine,  // the station's clock or pose cannot be believed
  kTooMany,     // more stations than there are places
  kFlood,       // more bearings of one station than there can be
  kLowBelief,
};
const char* to_string(BearingRefusal refusal);

// Whether a station can stand there: near the Earth's surface, with a deviation that is one.
bool is_a_stations_place(const Eigen::Vector3d& p_ecef, const Eigen::Vector3d& sd_enu_m);

// What can be judged of a bearing by itself.
BearingRefusal check(const BearingMeasurement& sighting);

}  // namespace ols::fusion
