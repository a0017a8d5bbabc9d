#include "wire/target.h"

#include <array>
#include <cmath>

#include "base/bus/message_code.h"
#include "base/text/plain_text.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "wire/read.h"

namespace ols::wire {

using Target = ols_msg::target_t;

std::optional<Target> decode_target(const BusMessage& message) {
  // Not the paper's estimates, whose channel begins with the same name.
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
  return word_of_code(state, std::array{"tentative", "confirmed", "coasted", "dropped"}, "dropped");
}

const char* solution_name(std::int8_t solution) {
  return word_of_code(solution,
                      std::array{"ok", "too-few-rays", "parallel-rays", "behind-camera", "too-far",
                                 "not-converged", "bearing-only", "rays-miss", "ambiguous"});
}

}  // namespace ols::wire
