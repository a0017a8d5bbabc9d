#include "edge/station/station_types.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bus/message_code.h"
#include "geometry/angles.h"

namespace ols::station {

const char* to_string(StationState state) {
  return word_of_code(code(state), std::array{"idle", "manual", "tracking", "coasting", "lost",
                                              "slewed", "stopped", "emergency", "hidden"});
}

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kNotFinite:
      return "not_finite";
    case Refusal::kOutOfRange:
      return "out_of_range";
    case Refusal::kUnreachable:
      return "unreachable";
    case Refusal::kNoFrame:
      return "no_frame";
    case Refusal::kNothingThere:
      return "nothing_there";
    case Refusal::kBox:
      return "box_outside_or_too_small";
    case Refusal::kTracker:
      return "tracker";
    case Refusal::kPrecedence:
      return "precedence";
    case Refusal::kEmergency:
      return "emergency";
    case Refusal::kNoReference:
      return "no_reference";
    case Refusal::kNoUnit:
      return "no_unit";
    case Refusal::kKeepOut:
      return "keep_out";
    case Refusal::kNoLens:
      return "no_lens";
    case Refusal::kOverview:
      return "overview";
    case Refusal::kFixedMount:
      return "fixed_mount";
    case Refusal::kOvertaken:
      return "overtaken";
    case Refusal::kStopped:
      return "stopped";
    case Refusal::kJustStopped:
      return "just_stopped";
    case Refusal::kNoDoubt:
      return "no_doubt";
    case Refusal::kRearmNeedsAHand:
      return "rearm_needs_a_hand";
  }
  return "unknown";
}

AzimuthElevation direction_at(const SlewCommand& slew, double time_s) {
  const double dt = time_s - slew.effect_s;
  return {wrap_two_pi(slew.direction.azimuth_rad + dt * slew.azimuth_rate_rad_s),
          slew.direction.elevation_rad + dt * slew.elevation_rate_rad_s};
}

bool differs(const sensors::StationPose& stated, const sensors::StationPose& now) {
  constexpr double kLeast_m = 1e-3, kLeast_rad = 1e-6;  // below any sensor's resolution
  if (stated.position_source != now.position_source || stated.tilt_source != now.tilt_source) {
    return true;
  }
  const Eigen::Vector3d moved_m =
      LocalFrame(stated.position).to_enu(ecef_from_geodetic(now.position));
  const Eigen::Array3d most_m = stated.position_sd_enu_m.array().max(kLeast_m);
  const double most_rad = std::max(stated.tilt_sd_rad, kLeast_rad);
  return (moved_m.array().abs() > most_m).any() ||
         std::abs(now.tilt_x_rad - stated.tilt_x_rad) > most_rad ||
         std::abs(now.tilt_y_rad - stated.tilt_y_rad) > most_rad;
}

}  // namespace ols::station
