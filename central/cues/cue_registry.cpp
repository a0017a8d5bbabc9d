#include "central/cues/cue_registry.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr double kHold_s = 2.0;    // a cue that is not repeated within this time ends
constexpr double kGate = 16.3;     // squared, in sigmas; 0.1 % of true matches exceed it
constexpr double kSettle_s = 0.1;  // between two searches for the target at each cue
constexpr double kLeap = 100.0;    // squared, in sigmas; a longer jump is another object

bool leaps(const CueAim& before, const Cue& cue) {
  const KinematicState expected = before.at(cue.state_us), now = CueAim{cue, 0.0}.at(cue.state_us);
  const Eigen::Vector3d off = (now.mean - expected.mean).head<3>();
  const Eigen::Matrix3d both = (now.covariance + expected.covariance).topLeftCorner<3, 3>();
  return off.dot(both.llt().solve(off)) > kLeap;
}

}  // namespace

bool is_there(const CueAim& aim, const Track& track, std::int64_t now_us) {
  const KinematicState cue = aim.at(now_us), target = track.filter.at(now_us);
  const Eigen::Vector3d off = (target.mean - cue.mean).head<3>();
  const Eigen::Matrix3d both = (target.covariance + cue.covariance).topLeftCorner<3, 3>();
  return off.dot(both.llt().solve(off)) <= kGate;
}

CueHealth health_of(const CueAim& aim, CueState state, std::int64_t target_id,
                    std::int64_t now_us) {
  const KinematicState now = aim.at(now_us);
  const Eigen::Matrix3d R = R_ecef_enu(aim.cue.place);
  const Eigen::Matrix3d enu = R.transpose() * now.covariance.topLeftCorner<3, 3>() * R;
  return {aim.cue.id,
          aim.cue.label,
          state,
          target_id,
          seconds(now_us - aim.cue.state_us),
          geodetic_from_ecef(now.mean.head<3>()),
          std::sqrt(enu(0, 0)),
          std::sqrt(enu(2, 2))};
}

bool CueRegistry::is_silent(const Live& live, std::int64_t present_us) const {
  return std::abs(seconds(present_us - live.heard_us)) > kHold_s ||
         seconds(present_us - live.cue.state_us) > config_.max_age_s + kHold_s;
}

// Only a new cue needs a free place, and silent cues give up theirs first.
CueRefusal CueRegistry::take(const Cue& cue, std::int64_t present_us,
                             const StationRegistry& stations) {
  const CueRefusal refusal = check(cue, present_us, config_);
  if (refusal != CueRefusal::kNone) return refusal;
  if (!is_in_area(cue, stations, config_.range_m)) return CueRefusal::kOutOfArea;
  end_silent(present_us);
  const bool is_new = !cues_.contains(cue.id);
  if (is_new && cues_.size() >= static_cast<std::size_t>(config_.most)) return CueRefusal::kTooMany;
  Live& live = cues_[cue.id];
  // Overtaken by a newer message.
  if (!is_new && cue.state_us < live.cue.state_us) return CueRefusal::kStale;
  // The operator allowed the object shown then, not another one under the same id.
  if (!is_new && live.allowed == true && leaps(CueAim{live.cue, config_.acceleration_sd_m_s2}, cue))
    live.allowed.reset();
  live.cue = cue;
  live.heard_us = present_us;
  return CueRefusal::kNone;
}

bool CueRegistry::order(const std::string& id, bool allow) {
  const auto live = cues_.find(id);
  if (live == cues_.end() || config_.allow == CueAllowance::kNever) return false;
  live->second.allowed = allow;
  return true;
}

void CueRegistry::end_silent(std::int64_t present_us) {
  std::erase_if(cues_, [&](const auto& cue) { return is_silent(cue.second, present_us); });
}

void CueRegistry::settle(std::int64_t now_us, const std::vector<Track>& tracks) {
  if (settled_us_ && std::abs(seconds(now_us - *settled_us_)) < kSettle_s) return;
  settled_us_ = now_us;
  for (auto& [id, live] : cues_) {
    const CueAim aim{live.cue, config_.acceleration_sd_m_s2};
    std::int64_t found = 0;
    for (const Track& track : tracks) {
      if (!is_established(track) || !is_there(aim, track, now_us)) continue;
      if (found == 0 || track.id == live.target_id) found = track.id;
    }
    live.target_id = found;
  }
}

CueState CueRegistry::state_of(const Live& live) const {
  const bool standing = config_.allow == CueAllowance::kAll;
  if (config_.allow == CueAllowance::kNever || !live.allowed.value_or(true)) {
    return CueState::kForbidden;
  }
  if (!live.allowed.value_or(standing)) return CueState::kWaiting;
  return live.target_id != 0 ? CueState::kFound : CueState::kSearched;
}

std::vector<CueAim> CueRegistry::aims(std::int64_t now_us) const {
  std::vector<CueAim> aims;
  for (const auto& [id, live] : cues_) {
    if (state_of(live) != CueState::kSearched || is_silent(live, now_us)) continue;
    aims.push_back({live.cue, config_.acceleration_sd_m_s2});
  }
  return aims;
}

std::vector<CueHealth> CueRegistry::health(std::int64_t now_us) const {
  std::vector<CueHealth> all;
  for (const auto& [id, live] : cues_) {
    const CueAim aim{live.cue, config_.acceleration_sd_m_s2};
    all.push_back(health_of(aim, state_of(live), live.target_id, now_us));
  }
  return all;
}

}  // namespace ols::fusion
