#include "export/gate.h"

#include <cmath>

namespace ols::exports {
namespace {

constexpr std::size_t kMostRemembered = 10'000;
// The records' own rate jitters: if it is a multiple of this one, the right record may be a little
// early.
constexpr double kEarly = 0.9;

}  // namespace

bool Gate::is_inside(const Place& place) const {
  return ols::is_inside(config_.area_deg, place.latitude_deg, place.longitude_deg);
}

bool Gate::is_due(const std::string& uid, std::int64_t utime_us, TrackState state) {
  if (last_.size() > kMostRemembered) last_.clear();
  const auto [known, is_new] = last_.try_emplace(uid, Last{.utime_us = utime_us, .state = state});
  if (is_new) return true;
  Last& last = known->second;
  const double passed_s = std::abs(static_cast<double>(utime_us - last.utime_us)) * 1e-6;
  if (state == last.state && passed_s < kEarly / config_.rate_hz) return false;
  last.utime_us = utime_us;
  last.state = state;
  return true;
}

std::optional<Target> Gate::pass(const Target& target) {
  if (!config_.targets) return std::nullopt;
  const auto known = last_.find(target.uid);
  const bool was_told = known != last_.end();
  Target told = target;
  const bool leaves = target.state != TrackState::kEnded && !is_inside(target.place);
  if (leaves) told.state = TrackState::kEnded;
  if (told.state == TrackState::kEnded) {
    if (!was_told) return std::nullopt;
    if (leaves) {  // nothing outside goes out, its place least of all
      told.place = known->second.place;
      told.covariance_m2 = known->second.covariance_m2;
      told.velocity_enu_m_s.fill(kUnknown);
    }
    last_.erase(known);
    return told;
  }
  if (told.state == TrackState::kTentative && !config_.tentative && !was_told) return std::nullopt;
  if (!is_due(told.uid, told.utime_us, told.state)) return std::nullopt;
  Last& last = last_.at(told.uid);
  last.place = told.place;
  last.covariance_m2 = told.covariance_m2;
  return told;
}

bool Gate::passes(const Station& station) {
  return config_.stations && is_inside(station.place) &&
         is_due(station.uid, station.utime_us, TrackState::kConfirmed);
}

bool Gate::passes(const Line& line) {
  return config_.lines && line.belief >= kLeastBelief && is_inside(line.camera) &&
         is_due(line.uid, line.utime_us, TrackState::kConfirmed);
}

bool Gate::passes(const Incident& incident) const {
  return config_.targets && is_inside(incident.place);
}

}  // namespace ols::exports
