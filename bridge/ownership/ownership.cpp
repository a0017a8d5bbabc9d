#include "bridge/ownership/ownership.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace ols::bridge {
namespace {

constexpr double kTrack_s = 0.6;    // a fusion silent about a target has lost it
constexpr double kFresh_s = 0.25;   // after longer silence, a target may have another number
constexpr double kForget_s = 60.0;  // of a target that nobody has
constexpr double kWish_s = 0.4, kWishHolds_s = 1.5;
constexpr double kOutside_s = 1.0;  // at first, only its own region may take a new target
constexpr double kUnanswered_s = 3.0;
constexpr double kDouble_s = 1.0;
constexpr double kSlack_m = 20.0, kSlack_m_s = 10.0;  // between two fusions' estimates; a turn
constexpr double kOldest_s = 10.0;                    // extrapolated no further
constexpr const char* kNobody = "-";                  // successor of a duplicate record

// A dead owner is replaced within the lease. The lease is no setting: with different leases, two
// fusions could own a target at the same instant.
constexpr double kLease_s = 2.0;
// Shares of the lease. An owner counts on kHeld, and another fusion waits for kInside or kOutside:
// the time between is for the store's write to a disk, and for the next fix.
constexpr double kHeld = 0.65, kInside = 0.7, kOutside = 0.775, kRenewed = 0.2;

double distance_m(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Vector predicted(const Vector& position, const Vector& velocity, double age_s) {
  Vector result = position;
  const double time_s = std::clamp(age_s, 0.0, kOldest_s);
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::isfinite(velocity[i])) result[i] += velocity[i] * time_s;
  }
  return result;
}

double depth_of(const OwnershipRules& rules, const Track& track) {
  return depth_m(rules.cell_deg, track.latitude_deg, track.longitude_deg);
}

double margin_of(const OwnershipRules& rules, const Track& track) {
  return std::max(rules.margin_m, 3.0 * track.sd_m);
}

}  // namespace

void Ownership::hear(const Track& track, const Now& now) {
  const auto [at, is_new] = tracks_.try_emplace(track.id);
  Seen& seen = at->second;
  seen.track = track;
  seen.seen_s = now.monotonic_s;
  if (is_new) seen.first_s = now.monotonic_s;
}

void Ownership::hear(const TargetReport& sighting, const Now& now) {
  const auto at = entries_.find(sighting.target);
  if (at == entries_.end()) return;
  Entry& entry = at->second;
  entry.place = sighting;
  entry.seen_s = now.monotonic_s;
  // An owner that the store has just confirmed has not been replaced, whatever a header says. After
  // that, a greater epoch puts the ownership in doubt: the store's next answer ends the doubt, or
  // the ownership.
  const bool is_confirmed = now.monotonic_s < entry.held_until_s;
  if (entry.is_mine && !is_confirmed && sighting.epoch > entry.epoch) entry.is_doubted = true;
}

void Ownership::learn(const std::string& target, const OwnerRecord& record, std::uint64_t revision,
                      const Now& now) {
  Entry& entry = entries_[target];
  if (revision <= entry.revision) return;
  const double age_s = 1e-6 * static_cast<double>(now.utime_us - record.utime_us);
  const double seen_s = now.monotonic_s - std::clamp(age_s, 0.0, kForget_s);
  if (seen_s > entry.seen_s) {
    entry.place = {target, record.position_m, record.velocity_m_s, record.sd_m};
    entry.seen_s = seen_s;
  }
  entry.place.target = target;
  keep(entry, record, revision, now);
  const bool is_own = record.owner == rules_.name;
  // The answer to our own request was lost, or is still on its way.
  if (is_own && entry.request.record.beat == record.beat) settle(entry, revision);
  if (!is_own && entry.is_mine) {
    entry.is_mine = false;
    ++(record.owner.empty() ? counts_.handed_over : counts_.lost);
  }
}

void Ownership::learn_gone(const std::string& target, const Now& now) {
  const auto at = entries_.find(target);
  if (at == entries_.end()) return;
  keep(at->second, OwnerRecord{}, 0, now);
  if (std::exchange(at->second.is_mine, false)) ++counts_.lost;
}

void Ownership::keep(Entry& entry, const OwnerRecord& record, std::uint64_t revision,
                     const Now& now) {
  if (now.monotonic_s - entry.marked_s >= kWishHolds_s) {
    entry.old_revision = std::exchange(entry.next_old_revision, entry.revision);
    entry.marked_s = now.monotonic_s;
  }
  entry.record = record;
  entry.revision = revision;
  entry.changed_s = now.monotonic_s;
  entry.is_doubted = false;
}

void Ownership::learn_wish(const std::string& target, const std::string& by, std::uint64_t revision,
                           const Now& now) {
  const auto at = entries_.find(target);
  if (at == entries_.end() || by == rules_.name) return;
  if (revision <= at->second.old_revision) return;
  at->second.wished_by = by;
  at->second.wished_s = now.monotonic_s;
}

// The record is this fusion's since the last request was sent.
void Ownership::settle(Entry& entry, std::uint64_t revision) {
  if (!entry.is_mine) {
    entry.is_mine = true;
    entry.epoch = revision;
    // These wishes were for the previous owner.
    entry.wished_by.clear();
    entry.old_revision = entry.next_old_revision = revision;
    ++counts_.taken;
  }
  entry.held_until_s = entry.request.asked_s + kHeld * kLease_s;
}

void Ownership::answer(const StoreRequest& request, StoreAnswer answer, std::uint64_t revision,
                       const Now& now) {
  const auto at = entries_.find(request.target);
  if (at == entries_.end()) return;
  Entry& entry = at->second;
  if (entry.request.what == Asked::kNothing || entry.request.record.beat != request.record.beat) {
    // The answer is to a request that was given up: its record counts like any other.
    if (answer == StoreAnswer::kDone) learn(request.target, request.record, revision, now);
    return;
  }
  const Asked what = std::exchange(entry.request.what, Asked::kNothing);
  if (answer != StoreAnswer::kDone) {
    // Another fusion has written there. If its record is not known yet, the ownership is in doubt
    // at once. A known one may be an earlier record of our own whose answer was lost.
    if (answer == StoreAnswer::kRefused && entry.revision == request.revision) {
      entry.is_doubted = true;
    }
    entry.due_s = std::max(entry.due_s, now.monotonic_s + 0.1);
    return;
  }
  if (revision > entry.revision) keep(entry, entry.request.record, revision, now);
  if (what == Asked::kRelease) {
    if (std::exchange(entry.is_mine, false)) ++counts_.handed_over;
  } else if (what != Asked::kNothing && entry.record.owner == rules_.name) {
    settle(entry, revision);
  }
}

void Ownership::feel_store(bool answers, const Now& now) {
  if (answers && !answers_) {
    for (auto& [target, entry] : entries_) entry.changed_s = now.monotonic_s;
  }
  answers_ = answers;
}

std::vector<StoreRequest> Ownership::step(const Now& now) {
  Requests requests;
  const double now_s = now.monotonic_s;
  std::erase_if(entries_, [this, now_s](const auto& one) {
    const Entry& entry = one.second;
    return !entry.is_mine && now_s - std::max(entry.changed_s, entry.seen_s) > kForget_s &&
           !is_bound(one.first, now_s);
  });
  for (auto& [target, entry] : entries_) {
    Request& request = entry.request;
    if (now_s - request.asked_s > kUnanswered_s) request.what = Asked::kNothing;
  }
  let_go(now, requests);
  bind(now);
  for (auto& [id, seen] : tracks_) {
    if (seen.target.empty()) {
      make(seen, now, requests);
      continue;
    }
    Entry& entry = entries_[seen.target];
    if (entry.request.what != Asked::kNothing) continue;
    if (entry.is_mine) {
      own(entry, seen, now, requests);
    } else {
      stand_by(entry, seen, now, requests);
    }
  }
  return requests;
}

// Another fusion may still see a target that this one has lost.
void Ownership::let_go(const Now& now, Requests& requests) {
  for (auto at = tracks_.begin(); at != tracks_.end();) {
    Seen& seen = at->second;
    if (now.monotonic_s - seen.seen_s <= kTrack_s) {
      ++at;
      continue;
    }
    const auto entry = entries_.find(seen.target);
    // The answer comes first: a target that was about to be taken must then be given up, too.
    if (entry != entries_.end() && entry->second.request.what != Asked::kNothing) {
      ++at;
      continue;
    }
    if (entry != entries_.end() && entry->second.is_mine) {
      OwnerRecord record = record_of(seen, now);
      record.owner.clear();
      ask(entry->second, Asked::kRelease, record, now.monotonic_s, requests);
    }
    at = tracks_.erase(at);
  }
}

bool Ownership::is_bound(const std::string& target, double now_s) const {
  return std::ranges::any_of(tracks_, [&target, now_s](const auto& one) {
    return one.second.target == target && now_s - one.second.seen_s <= kFresh_s;
  });
}

// Finds the known target of each track. A track keeps its target. A new track may be that of a
// target whose track has just fallen silent, as when a fusion starts again.
void Ownership::bind(const Now& now) {
  for (auto& [id, seen] : tracks_) {
    if (!seen.target.empty() && !entries_.contains(seen.target)) seen.target.clear();
  }
  for (auto& [id, seen] : tracks_) {
    if (!seen.target.empty()) continue;
    const std::string target = nearest(seen, now);
    if (target.empty()) continue;
    for (auto& [other, silent] : tracks_) {
      if (silent.target == target) silent.target.clear();
    }
    seen.target = target;
  }
}

std::string Ownership::nearest(const Seen& seen, const Now& now) const {
  const Track& track = seen.track;
  const Vector here =
      predicted(track.position_m, track.velocity_m_s, now.monotonic_s - seen.seen_s);
  std::string best;
  double least_m = 1e18;
  for (const auto& [target, entry] : entries_) {
    const double age_s = now.monotonic_s - entry.seen_s;
    if (entry.record.successor == kNobody || age_s > kForget_s) continue;
    const Vector there = predicted(entry.place.position_m, entry.place.velocity_m_s, age_s);
    const double gate_m = 3.0 * std::hypot(track.sd_m, entry.place.sd_m) + kSlack_m +
                          kSlack_m_s * std::clamp(age_s, 0.0, kOldest_s);
    const double apart_m = distance_m(here, there);
    if (apart_m > gate_m || apart_m >= least_m || is_bound(target, now.monotonic_s)) continue;
    least_m = apart_m;
    best = target;
  }
  return best;
}

// Two fusions that see a new target at once would both make a record of it, so each waits for a
// time of its own, computed from its name.
double Ownership::delay_s() const {
  return kFresh_s + 0.1 +
         0.35 * static_cast<double>(std::hash<std::string>{}(rules_.name) % 1000) / 1000.0;
}

void Ownership::make(Seen& seen, const Now& now, Requests& requests) {
  const double outside_s = depth_of(rules_, seen.track) < 0.0 ? kOutside_s : 0.0;
  if (!answers_ || now.monotonic_s - seen.first_s < delay_s() + outside_s) return;
  seen.target = rules_.name + "-" + std::to_string(++made_);
  Entry& entry = entries_[seen.target];
  entry.place = {seen.target, seen.track.position_m, seen.track.velocity_m_s, seen.track.sd_m};
  entry.seen_s = entry.changed_s = now.monotonic_s;
  ask(entry, Asked::kTaking, record_of(seen, now), now.monotonic_s, requests);
}

void Ownership::own(Entry& entry, const Seen& seen, const Now& now, Requests& requests) {
  const double now_s = now.monotonic_s;
  const bool is_wished = !entry.wished_by.empty() && now_s - entry.wished_s < kWishHolds_s &&
                         depth_of(rules_, seen.track) < 0.0;
  const bool is_one_too_many = is_double(entry, seen, now);
  if (is_wished || is_one_too_many) {
    OwnerRecord record = record_of(seen, now);
    record.owner.clear();
    record.successor = is_one_too_many ? kNobody : std::exchange(entry.wished_by, "");
    ask(entry, Asked::kRelease, record, now_s, requests);
    return;
  }
  if (now_s < entry.due_s) return;
  ask(entry, Asked::kRenewal, record_of(seen, now), now_s, requests);
  entry.due_s = now_s + kRenewed * kLease_s;
}

// Whether another fusion has a record of the same target that is to stay: that of the lesser name
// does.
bool Ownership::is_double(Entry& entry, const Seen& seen, const Now& now) const {
  const std::string other = nearest(seen, now);
  const auto at = entries_.find(other);
  const bool is_now = at != entries_.end() && !at->second.is_mine &&
                      !at->second.record.owner.empty() && other < seen.target &&
                      now.monotonic_s - at->second.seen_s < kDouble_s;
  if (!is_now) {
    entry.doubled_since_s = -1.0;
    return false;
  }
  if (entry.doubled_since_s < 0.0) entry.doubled_since_s = now.monotonic_s;
  return now.monotonic_s - entry.doubled_since_s > kDouble_s;
}

bool Ownership::may_take(const Entry& entry, double depth_m, double now_s) const {
  if (!answers_) return false;
  const double silent_s = now_s - entry.changed_s;
  const OwnerRecord& record = entry.record;
  if (!record.owner.empty()) {
    return silent_s > (depth_m < 0.0 ? kOutside : kInside) * kLease_s;
  }
  if (record.successor == rules_.name) return true;
  // First comes the fusion to which it was released, then the one whose region it is in, then any.
  const double wait_s = (record.successor.empty() ? 0.0 : 0.15) + (depth_m < 0.0 ? 0.15 : 0.0);
  return silent_s >= wait_s;
}

void Ownership::stand_by(Entry& entry, const Seen& seen, const Now& now, Requests& requests) {
  if (entry.record.successor == kNobody || now.monotonic_s < entry.due_s) return;
  const double depth = depth_of(rules_, seen.track);
  if (may_take(entry, depth, now.monotonic_s)) {
    ask(entry, Asked::kTaking, record_of(seen, now), now.monotonic_s, requests);
    return;
  }
  if (entry.record.owner.empty() || depth <= margin_of(rules_, seen.track)) return;
  if (now.monotonic_s < entry.wish_due_s) return;
  StoreRequest wish;
  wish.target = seen.target;
  wish.record.owner = rules_.name;
  wish.is_wish = true;
  requests.push_back(wish);
  entry.wish_due_s = now.monotonic_s + kWish_s;
}

void Ownership::ask(Entry& entry, Asked what, OwnerRecord record, double now_s,
                    Requests& requests) {
  entry.request = {what, std::move(record), now_s};
  // From here on nothing is certain: the answer may be lost although the release is done.
  if (what == Asked::kRelease) entry.held_until_s = now_s;
  requests.push_back({entry.place.target, entry.request.record, entry.revision, false});
}

OwnerRecord Ownership::record_of(const Seen& seen, const Now& now) {
  OwnerRecord record;
  record.owner = rules_.name;
  record.beat = ++beat_;
  record.utime_us = now.utime_us;
  record.position_m =
      predicted(seen.track.position_m, seen.track.velocity_m_s, now.monotonic_s - seen.seen_s);
  for (std::size_t i = 0; i < 3; ++i) {
    const double speed = seen.track.velocity_m_s[i];
    record.velocity_m_s[i] = std::isfinite(speed) ? speed : 0.0;
  }
  record.sd_m = seen.track.sd_m;
  return record;
}

std::optional<Grant> Ownership::grant(std::int64_t track_id, const Now& now) const {
  const auto seen = tracks_.find(track_id);
  if (seen == tracks_.end()) return std::nullopt;
  const auto at = entries_.find(seen->second.target);
  if (at == entries_.end()) return std::nullopt;
  const Entry& entry = at->second;
  if (!entry.is_mine || entry.is_doubted || entry.request.what == Asked::kRelease) {
    return std::nullopt;
  }
  return Grant{at->first, entry.epoch, now.monotonic_s < entry.held_until_s, rules_.name};
}

Ownership::Counts Ownership::counts(const Now& now) const {
  Counts counts = counts_;
  counts.is_confirmed = answers_;
  for (const auto& [target, entry] : entries_) {
    ++(entry.is_mine ? counts.owned : counts.others);
    if (entry.is_mine) counts.epoch = std::max(counts.epoch, entry.epoch);
    const bool is_held = entry.is_doubted || now.monotonic_s < entry.held_until_s;
    if (entry.is_mine && !is_held) counts.is_confirmed = false;
  }
  return counts;
}

}  // namespace ols::bridge
