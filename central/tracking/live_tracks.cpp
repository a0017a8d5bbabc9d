#include "central/tracking/live_tracks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "central/ground/visibility.h"
#include "central/measurement/time_span.h"
#include "central/tracking/appearance.h"
#include "central/tracking/position_guard.h"
#include "geometry/assignment.h"

namespace ols::fusion {
namespace {

constexpr double kConfirmed = 0.95, kDeleted = 0.05;  // probability of its existence
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

LiveTracks::LiveTracks(const TrackManagerConfig& config)
    : TrackManager(config, config.filter, true), duplicates_(config.duplicates) {}

std::vector<LiveTracks::Candidate> LiveTracks::candidates(const BearingMeasurement& measurement,
                                                          bool confirmed) const {
  std::vector<Candidate> found;
  if (tracks_.empty()) return found;
  const Eigen::Vector3d direction = direction_ecef(measurement.sight);
  const double off_rad = may_be_off_rad(measurement.sight);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!glances_[i].may_see(measurement, direction, off_rad)) continue;
    const Track& track = tracks_[i];
    if (is_established(track) != confirmed || track.state == TrackState::kDeleted) continue;
    if (track.has_taken(measurement)) continue;
    if (rate_nis(measurement, track.filter.summary()) > config_.filter.gate_nis) continue;
    Innovation seen = track.filter.innovation(measurement, errors_);
    if (seen.nis < config_.filter.gate_nis) found.push_back({i, std::move(seen)});
  }
  std::ranges::sort(found, {}, [](const Candidate& c) { return c.seen.nis; });
  return found;
}

namespace {

// For each row: its column, or -1; and whether another column fits about as well.
struct Choice {
  std::vector<int> column;
  std::vector<bool> is_ambiguous;
};

Choice choose(const Eigen::MatrixXd& cost, double unassigned, double least_difference) {
  Choice choice{assign(cost, unassigned), {}};
  const double least = cost_of(choice.column, cost, unassigned);
  for (Eigen::Index row = 0; row < cost.rows(); ++row) {
    const int column = choice.column[static_cast<std::size_t>(row)];
    const bool has_others = (cost.row(row).array() < kNever).count() > 1;
    bool ambiguous = false;
    if (column >= 0 && has_others) {
      Eigen::MatrixXd other = cost;
      other(row, column) = kNever;
      const std::vector<int> second = assign(other, unassigned);
      ambiguous = second[static_cast<std::size_t>(row)] >= 0 &&
                  cost_of(second, other, unassigned) - least < least_difference;
    }
    choice.is_ambiguous.push_back(ambiguous);
  }
  return choice;
}

}  // namespace

std::vector<Association> LiveTracks::add(std::span<const BearingMeasurement> image,
                                         bool may_begin) {
  std::vector<std::optional<Association>> fates(image.size());
  give(image, true, fates);
  const auto of_targets = fates;
  give(image, false, fates);
  note_clutter(image, of_targets, fates);
  std::vector<Association> all;
  for (std::size_t i = 0; i < image.size(); ++i)
    all.push_back(fates[i] ? *fates[i] : give_up(image[i], may_begin));
  judge_existence(image);
  if (config_.initiation.land) note_losses(image, all);
  return all;
}

// Only the tracks that may take one of the bearings have a column.
void LiveTracks::give(std::span<const BearingMeasurement> image, bool confirmed,
                      std::vector<std::optional<Association>>& fates) {
  std::vector<std::vector<Candidate>> near(image.size());
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (fates[i]) continue;
    near[i] = candidates(image[i], confirmed);
    for (const Candidate& candidate : near[i]) columns.push_back(candidate.track);
  }
  if (columns.empty()) return;
  std::ranges::sort(columns);
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  const Choice choice =
      choose(costs(image, near, columns), 2.0 * config_.filter.gate_nis, config_.ambiguous_nis);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (near[i].empty()) continue;
    if (confirmed) note_duplicates(image[i], near[i]);
    if (choice.column[i] < 0) continue;
    if (confirmed && choice.is_ambiguous[i]) {
      ++counts_.ambiguous;
      fates[i] = {Association::Kind::kAmbiguous, 0};
      continue;
    }
    const std::size_t track = columns[static_cast<std::size_t>(choice.column[i])];
    const auto chosen = std::ranges::find(near[i], track, &Candidate::track);
    fates[i] = give_to(tracks_[track], image[i], &chosen->seen);
  }
}

// A bearing of an object that the station follows is given to no other track.
Eigen::MatrixXd LiveTracks::costs(std::span<const BearingMeasurement> image,
                                  std::span<const std::vector<Candidate>> near,
                                  std::span<const std::size_t> columns) {
  Eigen::MatrixXd cost = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(image.size()),
                                                   std::ssize(columns), kNever);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (near[i].empty()) continue;
    const Track* const own = identities_.follower(image[i], tracks_);
    const auto is_own = [&](const Candidate& c) { return &tracks_[c.track] == own; };
    const bool has_own = std::ranges::any_of(near[i], is_own);
    for (const Candidate& candidate : near[i]) {
      if (has_own && !is_own(candidate)) continue;
      const auto column = std::ranges::lower_bound(columns, candidate.track) - columns.begin();
      cost(static_cast<Eigen::Index>(i), column) = candidate.seen.nis;
    }
  }
  return cost;
}

void LiveTracks::note_clutter(std::span<const BearingMeasurement> image,
                              std::span<const std::optional<Association>> of_targets,
                              std::span<const std::optional<Association>> of_any) {
  for (std::size_t i = 0; i < image.size(); ++i) {
    const BearingMeasurement& m = image[i];
    if (!m.is_tracklet) continue;
    if (of_targets[i] && of_targets[i]->kind == Association::Kind::kTrack) {
      clutter_.claimed(m);
    } else if (of_any[i]) {
      clutter_.undecided(m);
    } else if (!takes(m, m.utime_us, Activity::kFollowsS)) {
      clutter_.unclaimed(m);
    }
  }
}

// A bearing that no track explains.
Association LiveTracks::give_up(const BearingMeasurement& measurement, bool may_begin) {
  // A station that follows an object still follows it, even if its bearings scatter. The filter
  // gets the bearing, so that it detects a manoeuvre beyond its models.
  if (Track* const own = identities_.follower(measurement, tracks_); own != nullptr) {
    const Association result = give_to(*own, measurement);
    if (result.kind == Association::Kind::kTrack) return result;
  }
  ++counts_.unexplained;
  if (measurement.is_tracklet && takes(measurement, measurement.utime_us, Activity::kFollowsS))
    return {};
  const bool room = static_cast<int>(tracks_.size()) < config_.max_tracks;
  return may_begin && room ? initiate(measurement) : Association{};
}

void LiveTracks::note_duplicates(const BearingMeasurement& measurement,
                                 const std::vector<Candidate>& near) {
  if (near.size() < 2 && duplicates_.empty()) return;
  std::vector<std::int64_t> ids;
  for (const Candidate& candidate : near) {
    const Track& track = tracks_[candidate.track];
    const bool is_open = track.state == TrackState::kConfirmed && !track.has_taken(measurement);
    if (is_open) ids.push_back(track.id);
  }
  duplicates_.note(measurement, ids);
}

Association LiveTracks::initiate(const BearingMeasurement& measurement) {
  auto start = initiation_.add(measurement, errors_, false);
  if (!start) return {};
  errors_.learn(start->evidence);
  Track& begun = begin(std::move(start->track));
  if (measurement.is_tracklet) begun.existence.begin();
  consider(begun);
  // The searched bearing may be another station's, which has waited for its search.
  return begun.has_taken(measurement) ? Association{Association::Kind::kTrack, begun.id}
                                      : Association{};
}

// Judges by a detector's image. A target that the image does not show, and need not show, is not
// judged: it coasts.
void LiveTracks::judge_existence(std::span<const BearingMeasurement> image) {
  constexpr std::int64_t kRows_us = 25'000;  // of a rolling shutter, from one object to another
  const BearingMeasurement& any = image.front();
  if (!any.is_tracklet) return;
  for (Track& track : tracks_) {
    if (!track.existence.is_judged() || track.state == TrackState::kDeleted) continue;
    if (track.has_taken(any, kRows_us)) {
      track.existence.seen();
    } else if (should_show(any, track)) {
      track.existence.missed(visible(any, track));
    }
    if (track.existence.probability() < kDeleted) track.state = TrackState::kDeleted;
  }
}

double LiveTracks::visible(const BearingMeasurement& in_image, const Track& track) const {
  if (!config_.initiation.land) return 1.0;
  const KinematicState there = track.filter.at(in_image.utime_us);
  const Eigen::Vector3d& camera_ecef = in_image.sight.origin_ecef;
  const Eigen::Vector3d p_ecef = there.mean.head<3>();
  const Eigen::Matrix3d P = there.covariance.topLeftCorner<3, 3>();
  return clear_of_land(in_image.station, camera_ecef, p_ecef, P) *
         (1.0 - losses_.hidden(in_image.station, camera_ecef, p_ecef));
}

double LiveTracks::clear_of_land(const std::string& station, const Eigen::Vector3d& camera_ecef,
                                 const Eigen::Vector3d& p_ecef, const Eigen::Matrix3d& P) const {
  return std::min(visibility(*config_.initiation.land, camera_ecef, p_ecef, P),
                  skylines_.visibility(station, camera_ecef, p_ecef, P));
}

void LiveTracks::note_losses(std::span<const BearingMeasurement> image,
                             std::span<const Association> associations) {
  losses_.keep_only(tracks_);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Association& fate = associations[i];
    const auto track = std::ranges::find(tracks_, fate.track_id, &Track::id);
    if (fate.kind != Association::Kind::kTrack || fate.track_id == 0 || track == tracks_.end())
      continue;
    losses_.note(image[i], *track, [this](const auto&... of) { return clear_of_land(of...); });
  }
}

// Two other stations see it, it is in the field of view, and at its brightness the detector would
// find it.
bool LiveTracks::should_show(const BearingMeasurement& in_image, const Track& track) const {
  constexpr double kFound = 8.0;  // signal
  const Eigen::Vector3d p_ecef = track.filter.at(in_image.utime_us).mean.head<3>();
  if (!views_.shows(in_image, p_ecef)) return false;
  int others = 0;
  double brightness = 0.0;
  for (const auto& [station, bearings] : track.bearings) {
    if (station == in_image.station || bearings.empty()) continue;
    const BearingMeasurement& newest = bearings.back();
    if (seconds(in_image.utime_us - newest.utime_us) > Activity::kDeliversS) continue;
    ++others;
    const double squared_m2 = (p_ecef - newest.sight.origin_ecef).squaredNorm();
    brightness = std::max(brightness, newest.sighted.signal * squared_m2);
  }
  const double here_m2 = (p_ecef - in_image.sight.origin_ecef).squaredNorm();
  return others >= 2 && (brightness == 0.0 || brightness / here_m2 >= kFound);
}

// Whether another tracklet that belongs to no confirmed track may be the object that one of its
// two stations sees.
bool LiveTracks::has_rival(const Track& track) const {
  if (!track.existence.is_judged() || track.bearings.size() != 2) return false;
  const auto rivals_of = [&](const std::vector<BearingMeasurement>& own,
                             const std::vector<BearingMeasurement>& other) {
    const auto is_rival = [&](const BearingMeasurement& m) {
      return m.station == other.back().station && m.track_id != other.back().track_id &&
             initiation_.may_meet(own.back(), m, errors_);
    };
    const auto pooled = initiation_.pool().stations().find(other.back().station);
    const bool in_pool = pooled != initiation_.pool().stations().end() &&
                         std::ranges::any_of(pooled->second.bearings, is_rival);
    return in_pool || std::ranges::any_of(tracks_, [&](const Track& t) {
             const auto seen = t.bearings.find(other.back().station);
             return t.state == TrackState::kTentative && seen != t.bearings.end() &&
                    !seen->second.empty() && is_rival(seen->second.back());
           });
  };
  const auto& first = track.bearings.begin()->second;
  const auto& second = track.bearings.rbegin()->second;
  if (first.empty() || second.empty()) return false;
  return rivals_of(first, second) || rivals_of(second, first);
}

// Whether clutter causes such pairs, with an agreement as long as theirs, more often than may be
// published.
bool LiveTracks::may_agree_by_chance(const Track& track) const {
  const double agreed_s = seconds(track.filter.utime_us() - track.initiated_us);
  if (!track.existence.is_judged() || agreed_s < config_.confirm_s) return false;
  std::vector<std::pair<int, std::string>> most;  // a third one may have a bearing by chance, too
  for (const auto& [name, count] : track.hits) most.emplace_back(count, name);
  std::ranges::sort(most, std::greater<>());
  if (most.size() < 2) return false;
  const bool is_a_pair = most.size() == 2 || most[2].first < config_.confirm_hits;
  return is_a_pair &&
         clutter_.pairs_a_day(most[0].second, most[1].second, agreed_s) > most_of_a_pair();
}

bool LiveTracks::is_ambiguous() const {
  return std::ranges::any_of(tracks_, [&](const Track& track) {
    return track.state == TrackState::kTentative &&
           (has_rival(track) || may_agree_by_chance(track));
  });
}

bool LiveTracks::is_worth_confirming(const Track& track) const {
  int stations = 0, of_a_pair = 0, hits = 0;
  for (const auto& [name, count] : track.hits) {
    stations += count >= config_.confirm_hits ? 1 : 0;
    of_a_pair += count >= config_.confirm_pair_hits ? 1 : 0;
    hits += count;
  }
  if (track.misses > hits || track.existence.probability() < kConfirmed) return false;
  if (stations >= config_.confirm_stations) return true;
  return of_a_pair >= 2 &&
         seconds(track.filter.utime_us() - track.initiated_us) >= config_.confirm_s &&
         !has_rival(track) && !may_agree_by_chance(track);
}

bool LiveTracks::is_tentative_lost(double unseen_s) const {
  return unseen_s > config_.tentative_delete_s || unseen_s > config_.drop_s;
}

// A track that one station alone sees is kept for a short time; for less if its bearings disagree
// with the others' although the covariance was inflated.
bool LiveTracks::is_lost(const Track& track, double unseen_s, std::int64_t now_us) const {
  const bool parted = unseen_s > config_.coast_s &&
                      consecutive_rejections(track.filter, now_us) >= 2 * kMaxConsecutiveRejections;
  return parted || unseen_s > config_.drop_s;
}

void LiveTracks::merge_duplicates() {
  for (const auto& [older, younger] : duplicates_.same()) merge(older, younger);
}

// Two tracks are one object. The one with more of its bearings stays, with the older identity.
void LiveTracks::merge(std::int64_t older, std::int64_t younger) {
  duplicates_.forget(younger);
  const auto own = std::ranges::find(tracks_, older, &Track::id);
  const auto other = std::ranges::find(tracks_, younger, &Track::id);
  if (own == tracks_.end() || other == tracks_.end() || !is_established(*own) ||
      !is_established(*other))
    return;
  const auto bearings = [](const Track& track) {
    std::size_t sum = 0;
    for (const auto& [station, kept] : track.bearings) sum += kept.size();
    return sum;
  };
  if (bearings(*other) > bearings(*own)) std::swap(*own, *other);
  own->id = older;
  other->id = 0;
  other->state = TrackState::kDeleted;
  identities_.merge(older, younger);
  constexpr std::size_t kKeptMerged = 64;  // in live use, nobody takes them
  if (merged_.size() == kKeptMerged) merged_.erase(merged_.begin());
  merged_.emplace_back(older, younger);
  ++counts_.merged;
}

void LiveTracks::clear() {
  clear_tracks();
  duplicates_ = DuplicateTracks(config_.duplicates);
  clutter_ = {};
  merged_.clear();
  skylines_.clear();
  losses_.clear();
}

}  // namespace ols::fusion
