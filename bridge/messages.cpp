#include "bridge/messages.h"

#include <algorithm>
#include <cmath>

#include "base/bus/lcm_bus.h"
#include "ols_msg/occlusion_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/target_t.hpp"

namespace ols::bridge {
namespace {

template <class Message>
std::optional<Message> decoded(Bytes payload) {
  Message message{};
  if (!decode_exactly(payload.data(), static_cast<int>(payload.size()), message)) {
    return std::nullopt;
  }
  return message;
}

bool is_place(const ols_msg::target_t& target) {
  constexpr double kFarthest_m = 1e8;
  return std::ranges::all_of(
             target.position_ecef_m,
             [](double value) { return std::isfinite(value) && std::abs(value) < kFarthest_m; }) &&
         std::abs(target.latitude_deg) <= 90.0 && std::abs(target.longitude_deg) <= 360.0;
}

}  // namespace

std::optional<std::int64_t> target_id_of(Kind kind, Bytes payload) {
  if (kind == Kind::kTarget) {
    const auto target = decoded<ols_msg::target_t>(payload);
    return target ? std::optional(target->target_id) : std::nullopt;
  }
  if (const auto slew = decoded<ols_msg::slew_t>(payload)) return slew->target_id;
  const auto occlusion = decoded<ols_msg::occlusion_t>(payload);
  return occlusion ? std::optional(occlusion->target_id) : std::nullopt;
}

std::optional<Track> track_from(Bytes payload) {
  const auto target = decoded<ols_msg::target_t>(payload);
  if (!target || target->target_id == 0 || target->solution != ols_msg::target_t::SOLUTION_OK ||
      target->track_state == ols_msg::target_t::TRACK_DROPPED || !is_place(*target)) {
    return std::nullopt;
  }
  Track track;
  track.id = target->target_id;
  std::ranges::copy(target->position_ecef_m, track.position_m.begin());
  std::ranges::copy(target->velocity_ecef_m_s, track.velocity_m_s.begin());
  const double* const covariance = target->position_covariance_enu_m2;
  const double variance_m2 = covariance[0] + covariance[3] + covariance[5];
  track.sd_m = std::isfinite(variance_m2) ? std::sqrt(std::max(0.0, variance_m2)) : 0.0;
  track.latitude_deg = target->latitude_deg;
  track.longitude_deg = target->longitude_deg;
  return track;
}

std::optional<TargetReport> sighting_from(const Headers& headers, Bytes payload) {
  const auto claim = claim_of(headers);
  const auto track = track_from(payload);
  if (!claim || claim->target.empty() || !track) return std::nullopt;
  return TargetReport{claim->target, track->position_m, track->velocity_m_s, track->sd_m,
                      claim->epoch};
}

}  // namespace ols::bridge
