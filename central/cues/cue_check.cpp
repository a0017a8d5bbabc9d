#include "central/cues/cue_check.h"

#include <algorithm>

#include "geometry/angles.h"
#include "wire/cue_values.h"

namespace ols::fusion {
namespace {

CueFault fault_of(const Cue& cue) {
  const Eigen::Vector3d& velocity = cue.velocity_enu_m_s;
  return ols::fault_of({degrees(cue.place.latitude_rad),
                        degrees(cue.place.longitude_rad),
                        cue.place.height_m,
                        cue.horizontal_sd_m,
                        cue.vertical_sd_m,
                        {velocity.x(), velocity.y(), velocity.z()},
                        cue.velocity_sd_m_s});
}

}  // namespace

const char* to_string(CueRefusal refusal) {
  switch (refusal) {
    case CueRefusal::kNotFinite:
      return "cues_not_finite";
    case CueRefusal::kOutOfRange:
      return "cues_out_of_range";
    case CueRefusal::kPole:
      return "cues_at_the_pole";
    case CueRefusal::kStale:
      return "cues_stale";
    case CueRefusal::kFuture:
      return "cues_future";
    case CueRefusal::kVague:
      return "cues_vague";
    case CueRefusal::kOutOfArea:
      return "cues_out_of_area";
    case CueRefusal::kTooMany:
      return "cues_too_many";
    case CueRefusal::kNone:
    case CueRefusal::kCount:
      break;
  }
  return "unknown";
}

CueRefusal check(const Cue& cue, std::int64_t present_us, const CueConfig& config) {
  constexpr double kFuture_s = 1.0, kLongestWay_s = 1.0;
  const CueFault fault = fault_of(cue);
  if (fault == CueFault::kNotFinite) return CueRefusal::kNotFinite;
  if (std::min(cue.utime_us, cue.state_us) < 0 ||
      std::max(cue.utime_us, cue.state_us) > kGreatestUtime) {
    return CueRefusal::kOutOfRange;
  }
  if (fault == CueFault::kOutOfRange || cue.id.empty()) return CueRefusal::kOutOfRange;
  if (fault == CueFault::kPole) return CueRefusal::kPole;
  const auto age_s = [&](std::int64_t utime_us) {
    return 1e-6 * (static_cast<double>(present_us) - static_cast<double>(utime_us));
  };
  // The position may be old when its source sends it; the message itself must not be delayed.
  if (age_s(cue.state_us) > config.max_age_s || age_s(cue.utime_us) > kLongestWay_s) {
    return CueRefusal::kStale;
  }
  if (std::min(age_s(cue.state_us), age_s(cue.utime_us)) < -kFuture_s) return CueRefusal::kFuture;
  if (std::max(cue.horizontal_sd_m, cue.vertical_sd_m) > config.most_sd_m) {
    return CueRefusal::kVague;
  }
  return CueRefusal::kNone;
}

bool is_in_area(const Cue& cue, const StationRegistry& stations, double range_m) {
  const Eigen::Vector3d p_ecef = ecef_from_geodetic(cue.place);
  return std::ranges::any_of(stations.all(), [&](const auto& station) {
    const Eigen::Vector3d& camera_ecef = station.second.traits.camera_ecef;
    return !camera_ecef.isZero() && (p_ecef - camera_ecef).norm() <= range_m;
  });
}

}  // namespace ols::fusion
