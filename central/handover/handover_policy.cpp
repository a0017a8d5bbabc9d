#include "central/handover/handover_policy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr double kSettle_s = 0.1;  // between two looks at the tracks
// Priority of a target that an operator wants, over one without a decision.
constexpr double kWantedFactor = 10.0;
constexpr std::size_t kMostTold = 64;  // as many as cues

bool is_designated_there(const Track& track) {
  return std::ranges::any_of(track.bearings, [](const auto& own) {
    return std::ranges::any_of(own.second,
                               [](const auto& m) { return !m.is_tracklet && !m.is_acquired; });
  });
}

// The target's predicted motion, in the form of a cue.
CueAim aim_of(std::int64_t target_id, const KinematicState& state, double acceleration_sd_m_s2) {
  const Geodetic place = geodetic_from_ecef(state.mean.head<3>());
  const Eigen::Matrix3d R = R_ecef_enu(place);
  const Eigen::Matrix3d enu = R.transpose() * state.covariance.topLeftCorner<3, 3>() * R;
  Cue cue;
  cue.id = std::to_string(target_id);
  cue.utime_us = cue.state_us = state.utime_us;
  cue.place = place;
  cue.horizontal_sd_m = std::sqrt(std::max(enu(0, 0), enu(1, 1)));
  cue.vertical_sd_m = std::sqrt(enu(2, 2));
  cue.velocity_enu_m_s = R.transpose() * state.mean.segment<3>(3);
  cue.velocity_sd_m_s = std::sqrt(state.covariance.block<3, 3>(3, 3).trace() / 3.0);
  return {cue, acceleration_sd_m_s2};
}

constexpr std::pair<HandoverMode, std::string_view> kModes[] = {
    {HandoverMode::kOff, "off"},
    {HandoverMode::kPropose, "propose"},
    {HandoverMode::kAutomatic, "automatic"}};

}  // namespace

std::string to_string(HandoverMode mode) {
  return std::string(
      std::ranges::find(kModes, mode, [](const auto& m) { return m.first; })->second);
}

std::optional<HandoverMode> handover_mode_named(std::string_view name) {
  for (const auto& [mode, own] : kModes) {
    if (own == name) return mode;
  }
  return std::nullopt;
}

void HandoverPolicy::settle(std::int64_t now_us, const std::vector<Track>& tracks) {
  if (settled_us_ && std::abs(seconds(now_us - *settled_us_)) < kSettle_s) return;
  settled_us_ = now_us;
  for (auto& [id, known] : targets_) {
    const auto track = std::ranges::find(tracks, id, &Track::id);
    known.is_live = track != tracks.end() && is_established(*track);
  }
  for (const Track& track : tracks) {
    if (is_established(track)) note(track, now_us);
  }
  std::erase_if(targets_, [&](const auto& target) {
    const Known& known = target.second;
    return !known.is_live && !is_sought(known, now_us) && !is_remembered(known, now_us);
  });
}

// An operator who designates a dismissed object again wants it back.
void HandoverPolicy::note_dismissed(Known& known, const Track& track) {
  std::set<std::pair<std::string, std::int64_t>> there, designated;
  for (const auto& [station, bearings] : track.bearings) {
    for (const BearingMeasurement& m : bearings) {
      if (m.is_tracklet) continue;
      there.emplace(station, m.track_id);
      if (!m.is_acquired) designated.emplace(station, m.track_id);
    }
  }
  if (!known.dismissed) {
    known.dismissed = std::move(there);
    known.is_designated = false;
  } else if (!std::ranges::includes(*known.dismissed, designated)) {
    known.allowed.reset();
  }
}

void HandoverPolicy::note(const Track& track, std::int64_t now_us) {
  const bool is_new = !targets_.contains(track.id);
  Known& known = targets_[track.id];
  known.is_live = true;
  if (known.allowed == false) note_dismissed(known, track);
  if (known.allowed != false && is_designated_there(track)) known.is_designated = true;
  known.last = track.filter.at(track.filter.utime_us());
  known.object_class = appearance_of(track, track.filter.position()).object_class;
  if (is_new) inherit(known, track, now_us);
  if (leads(known)) known.has_led = true;
}

// A lost target at the position of this track has been found again: its search ends, and the
// operator's decision passes to this track, once.
void HandoverPolicy::inherit(Known& known, const Track& track, std::int64_t now_us) {
  for (auto other = targets_.begin(); other != targets_.end();) {
    const bool is_it = !other->second.is_live && is_there(aim_of(other->first, other->second.last,
                                                                 config_.acceleration_sd_m_s2),
                                                          track, now_us);
    if (is_it && other->second.allowed) known.allowed = other->second.allowed;
    if (is_it && other->second.is_designated) known.is_designated = true;
    if (is_it && other->second.has_led) known.has_led = true;
    other = is_it ? targets_.erase(other) : std::next(other);
  }
}

bool HandoverPolicy::order(std::int64_t target_id, bool allow) {
  const auto known = targets_.find(target_id);
  if (known == targets_.end() || (allow && config_.mode == HandoverMode::kOff)) return false;
  known->second.allowed = allow;
  known->second.dismissed.reset();
  return true;
}

bool HandoverPolicy::leads(const Known& known) const {
  if (known.allowed == false) return false;
  if (known.is_designated) return true;
  if (known.allowed) return config_.mode != HandoverMode::kOff;
  return leads_by_itself(known.object_class);
}

bool HandoverPolicy::leads_by_itself(ObjectClass object_class) const {
  return config_.mode == HandoverMode::kAutomatic &&
         std::ranges::find(config_.classes, object_class) != config_.classes.end();
}

// A target that is not known yet leads only if it is designated.
double HandoverPolicy::priority(const Track& track) const {
  const auto found = targets_.find(track.id);
  const bool is_designated =
      found == targets_.end() ? is_designated_there(track) : found->second.is_designated;
  const bool is_led = found == targets_.end() ? is_designated : leads(found->second);
  if (!is_led) return 0.0;
  const bool is_wanted = is_designated || found->second.allowed.value_or(false);
  return track.existence.probability() * (is_wanted ? kWantedFactor : probability_to_lead(track));
}

bool HandoverPolicy::is_wanted(std::int64_t target_id) const {
  const auto found = targets_.find(target_id);
  return found != targets_.end() &&
         (found->second.is_designated || found->second.allowed.value_or(false));
}

// Before it has been looked at, each class is as probable as the others.
double HandoverPolicy::probability_to_lead(const Track& track) const {
  constexpr double kLeast = 0.05;
  const auto of_classes = track.classes.posterior();
  double all = 0.0, leading = 0.0;
  for (std::size_t i = 1; i < of_classes.size(); ++i) {
    const double probability = track.classes.has_looked() ? of_classes[i] : 1.0;
    all += probability;
    if (leads_by_itself(static_cast<ObjectClass>(i))) leading += probability;
  }
  return std::max(kLeast, leading / all);
}

bool HandoverPolicy::is_let_go(std::int64_t target_id) const {
  const auto found = targets_.find(target_id);
  if (found == targets_.end()) return false;
  const Known& known = found->second;
  if (known.allowed) return !*known.allowed;
  return config_.mode == HandoverMode::kAutomatic && known.has_led && !leads(known);
}

bool HandoverPolicy::is_dismissed(std::int64_t target_id) const {
  const auto found = targets_.find(target_id);
  return found != targets_.end() && found->second.allowed == false;
}

bool HandoverPolicy::is_sought(const Known& known, std::int64_t now_us) const {
  return config_.mode != HandoverMode::kOff && leads(known) &&
         seconds(now_us - known.last.utime_us) <= config_.seek_s;
}

bool HandoverPolicy::is_remembered(const Known& known, std::int64_t now_us) const {
  return (known.is_designated || known.allowed.has_value()) &&
         seconds(now_us - known.last.utime_us) <= config_.remember_s;
}

std::vector<CueAim> HandoverPolicy::lost(std::int64_t now_us) const {
  std::vector<CueAim> aims;
  for (const auto& [id, known] : targets_) {
    if (!known.is_live && is_sought(known, now_us))
      aims.push_back(aim_of(id, known.last, config_.acceleration_sd_m_s2));
  }
  return aims;
}

CueState HandoverPolicy::state_of(const Known& known) const {
  if (known.allowed == false) return CueState::kForbidden;
  if (!leads(known)) return CueState::kWaiting;
  return known.is_live ? CueState::kFound : CueState::kSearched;
}

std::vector<CueHealth> HandoverPolicy::health(std::int64_t now_us) const {
  std::vector<CueHealth> all;
  if (config_.mode == HandoverMode::kOff) return all;
  for (const auto& [id, known] : targets_) {
    const bool is_told = known.is_live ? !known.is_designated || known.allowed.has_value()
                                       : known.allowed == false || is_sought(known, now_us);
    if (!is_told || all.size() == kMostTold) continue;
    all.push_back(health_of(aim_of(id, known.last, config_.acceleration_sd_m_s2), state_of(known),
                            known.is_live ? id : 0, now_us));
  }
  return all;
}

}  // namespace ols::fusion
