#include "wire/target.h"

#include <cmath>

#include "base/text/plain_text.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "wire/read.h"

namespace ols::wire {

using Target = ols_msg::target_t;

std::optional<Target> heard_target(const BusMessage& message) {
  // Not of the paper's estimator, whose channel begins with the same name.
  if (message.channel != kTargetChannel) return std::nullopt;
  auto target = read<Target>(kTargetChannel, message);
  if (!target) return std::nullopt;
  target->estimator = plain_text(target->estimator);
  for (std::string& station : target->station) station = plain_text(station);
  return target;
}

bool is_place(double latitude_deg, double longitude_deg, double height_m) {
  constexpr double kMostHeight_m = 1e6;
  return std::abs(latitude_deg) <= 90.0 && std::abs(longitude_deg) <= 360.0 &&
         std::abs(height_m) <= kMostHeight_m;
}

bool has_position(const Target& target) {
  return target.target_id != 0 && target.solution == Target::SOLUTION_OK &&
         target.track_state != Target::TRACK_DROPPED &&
         is_place(target.latitude_deg, target.longitude_deg, target.height_m);
}

Eigen::Vector3d velocity_enu(const Target& target) {
  const Geodetic at{radians(target.latitude_deg), radians(target.longitude_deg), target.height_m};
  return R_ecef_enu(at).transpose() * Eigen::Vector3d(target.velocity_ecef_m_s);
}

const char* track_name(std::int8_t state) {
  return state == Target::TRACK_BORN        ? "born"
         : state == Target::TRACK_CONFIRMED ? "confirmed"
         : state == Target::TRACK_COASTED   ? "coasted"
                                            : "dropped";
}

const char* solution_name(std::int8_t solution) {
  switch (solution) {
    case Target::SOLUTION_OK:
      return "ok";
    case Target::SOLUTION_TOO_FEW_RAYS:
      return "too-few-rays";
    case Target::SOLUTION_PARALLEL_RAYS:
      return "parallel-rays";
    case Target::SOLUTION_BEHIND_CAMERA:
      return "behind-camera";
    case Target::SOLUTION_TOO_FAR:
      return "too-far";
    case Target::SOLUTION_NOT_CONVERGED:
      return "not-converged";
    case Target::SOLUTION_BEARING_ONLY:
      return "bearing-only";
    case Target::SOLUTION_RAYS_MISS:
      return "rays-miss";
    default:
      return "unknown";
  }
}

const char* class_name(std::int8_t object_class) {
  return object_class == Target::CLASS_DRONE      ? "drone"
         : object_class == Target::CLASS_BIRD     ? "bird"
         : object_class == Target::CLASS_AIRCRAFT ? "aircraft"
         : object_class == Target::CLASS_OTHER    ? "other"
                                                  : "unknown";
}

}  // namespace ols::wire
