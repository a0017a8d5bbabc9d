#include "central/fusion/slew_schedule.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "central/fusion/output_period.h"
#include "central/measurement/ray.h"
#include "central/measurement/time_span.h"

namespace ols::fusion {
namespace {

constexpr int kStationsABearing = 16;
constexpr double kStepBack_s = 0.5;

CueRay cue_ray(const BearingOnly& line, std::int64_t now_us) {
  const RayFrame frame = ray_frame(line.sight);
  const Eigen::Matrix2d covariance = line.sight.covariance_white + line.sight.covariance_systematic;
  return {line.station,
          line.track_id,
          now_us,
          line.sight.origin_ecef,
          frame.direction,
          frame.tangent * line.rate_rad_s,
          std::sqrt(covariance.trace() / 2.0)};
}

}  // namespace

// A target that leads nobody is as if the station did not see it.
SlewStation SlewSchedule::station_of(const std::string& name, const KnownStation& station,
                                     std::int64_t now_us) const {
  const std::int64_t seen = station.follows(now_us);
  const auto priority = round_.priority.find(seen);
  const bool leads = priority == round_.priority.end() || priority->second > 0.0;
  const auto let_go = let_go_.find(name);
  return {name, station.traits, leads ? seen : 0,
          std::ranges::find(staring_, name) != staring_.end(),
          let_go == let_go_.end() ? 0 : let_go->second};
}

// A station's tracker stays with its target until somebody says otherwise.
void SlewSchedule::find_what_is_let_go(const std::vector<Track>& tracks,
                                       const HandoverPolicy& handover) {
  let_go_.clear();
  for (const Track& track : tracks) {
    if (!handover.is_let_go(track.id)) continue;
    for (const auto& [station, bearings] : track.bearings) {
      const auto newest = std::ranges::find(bearings.rbegin(), bearings.rend(), false,
                                            &BearingMeasurement::is_tracklet);
      if (newest != bearings.rend()) let_go_[station] = newest->track_id;
    }
  }
}

void SlewSchedule::begin(std::int64_t now_us, const StationRegistry& stations,
                         const BearingLines& lines, const std::vector<Track>& tracks,
                         const CueRegistry& cues, const HandoverPolicy& handover) {
  begun_us_ = now_us;
  next_ = "";
  round_ = {.now_us = now_us};
  for (const Track& track : tracks) round_.priority[track.id] = handover.priority(track);
  find_what_is_let_go(tracks, handover);
  std::vector<SlewStation> all;
  for (const auto& [name, station] : stations.all()) {
    all.push_back(station_of(name, station, now_us));
    if (all.back().follows != 0) ++round_.seen_by[all.back().follows];
  }
  planner_.allocate(round_, all, tracks);
  round_.cues = cues.aims(now_us);
  std::ranges::move(handover.lost(now_us), std::back_inserter(round_.cues));
  cue(now_us, lines);
  if (!round_.ray) return;
  share_out(all);
  narrow_by_cue();
}

// A station's line: of what it has been told to follow, else of the oldest tracklet that may be
// searched. Null: none.
const BearingMeasurement* SlewSchedule::line_of(const std::string& station,
                                                const std::vector<const BearingMeasurement*>& own) {
  const auto told = std::ranges::find_if(own, [](const auto* line) { return !line->is_tracklet; });
  if (told != own.end()) return *told;
  const BearingMeasurement* oldest = nullptr;
  for (const BearingMeasurement* line : own) {  // each is noted
    if (may_search({station, line->track_id}) && oldest == nullptr) oldest = line;
  }
  return oldest;
}

// Not at once: the other stations may be about to see the object where they look. And not for ever:
// it may be of anything, and of something that no other station can see.
bool SlewSchedule::may_search(const TrackletName& tracklet) {
  constexpr double kWait_s = 0.7, kLongest_s = 10.0;
  const std::int64_t now_us = round_.now_us;
  Tracklet& known = tracklets_.try_emplace(tracklet, Tracklet{now_us}).first->second;
  known.seen_us = now_us;
  return seconds(now_us - known.noted_us) >= kWait_s &&
         (!known.searched_us || seconds(now_us - *known.searched_us) < kLongest_s);
}

// The ray of the round before, while it lasts: another one would begin all searches anew.
void SlewSchedule::cue(std::int64_t now_us, const BearingLines& lines) {
  constexpr double kForget_s = 2.0;  // of a tracklet that has ended, or that a target has taken
  std::map<std::pair<bool, std::string>, CueRay> rays;  // tracklets' behind the others
  for (const std::string& station : lines.stations(now_us)) {
    const BearingMeasurement* own = line_of(station, lines.of(station, now_us));
    if (own == nullptr) continue;  // many detections, not an object that it follows
    if (!own->is_tracklet) round_.bearing_only_stations.insert(station);
    const std::pair key{own->is_tracklet, station};
    if (!rays.empty() && rays.begin()->first < key && station != cued_by_) continue;
    if (const auto line = lines.at(*own, now_us)) rays[key] = cue_ray(*line, now_us);
  }
  std::erase_if(tracklets_, [&](const auto& tracklet) {
    return std::abs(seconds(now_us - tracklet.second.seen_us)) > kForget_s;
  });
  if (rays.empty()) return;
  const bool by_tracklet = rays.begin()->first.first;
  const auto before = rays.find({by_tracklet, cued_by_});
  round_.ray = before != rays.end() ? before->second : rays.begin()->second;
  cued_by_ = round_.ray->station;
  round_.bearing_only_stations.insert(cued_by_);
  if (!by_tracklet) return;
  auto& searched_us = tracklets_[{cued_by_, round_.ray->track_id}].searched_us;
  if (!searched_us) searched_us = now_us;
}

// Where the stations that search stand to see a target: over the circle that they make.
void SlewSchedule::share_out(const std::vector<SlewStation>& stations) {
  std::vector<Eigen::Vector3d> places;
  for (const SlewStation& station : stations) {
    if (!station.is_led() || station.traits.camera_ecef.isZero()) continue;
    places.push_back(station.traits.camera_ecef);
    const bool searches =
        station.follows == 0 && !round_.bearing_only_stations.contains(station.station);
    const auto rank = static_cast<int>(round_.shares.size());
    if (searches) round_.shares.emplace(station.station, LineShare{rank, 0});
  }
  for (auto& [name, share] : round_.shares) share.of = static_cast<int>(round_.shares.size());
  if (places.empty()) return;
  const auto count = static_cast<double>(places.size());
  const Eigen::Vector3d middle =
      std::accumulate(places.begin(), places.end(), Eigen::Vector3d(0.0, 0.0, 0.0)) / count;
  double squared_m2 = 0.0;
  for (const Eigen::Vector3d& place : places) squared_m2 += (place - middle).squaredNorm() / count;
  const CueRay& ray = *round_.ray;
  constexpr double kLeastSd_m = 50.0;
  round_.prior = {(middle - ray.origin_ecef).dot(ray.direction_ecef),
                  std::max(kLeastSd_m, std::sqrt(squared_m2) / 2.0)};
}

// Of a ray that passes a cue, the cue says how far out the target is.
void SlewSchedule::narrow_by_cue() {
  constexpr double kSigmas = 3.0, kLeastSd_m = 10.0;
  const CueRay& ray = *round_.ray;
  for (const CueAim& aim : round_.cues) {
    const KinematicState cue = aim.at(round_.now_us);
    const Eigen::Vector3d line = cue.mean.head<3>() - ray.origin_ecef;
    const double range_m = line.dot(ray.direction_ecef);
    const double sd_m = std::sqrt(cue.covariance.topLeftCorner<3, 3>().trace() / 3.0);
    const double off_m = (line - range_m * ray.direction_ecef).norm();
    if (range_m <= 0.0 || off_m > kSigmas * std::hypot(sd_m, ray.sd_rad * range_m)) continue;
    round_.prior = {range_m, std::max(kLeastSd_m, sd_m)};
    round_.cue_on_ray = aim.cue.id;
    return;
  }
}

std::vector<Slew> SlewSchedule::plan(std::int64_t now_us, const StationRegistry& stations,
                                     const BearingLines& lines, const std::vector<Track>& tracks,
                                     const CueRegistry& cues, const HandoverPolicy& handover) {
  // Cues come with another clock than bearings.
  if (begun_us_ && seconds(*begun_us_ - now_us) > kStepBack_s) {
    begun_us_.reset();
    next_.reset();
  }
  if (next_ && seconds(now_us - *begun_us_) > give_up_s_) next_.reset();
  if (!next_ && is_due(begun_us_, now_us, config_.rate_hz)) {
    begin(now_us, stations, lines, tracks, cues, handover);
  }
  if (!next_) return {};
  round_.now_us = now_us;  // a round may take a while; each slew is for the time of its creation
  std::vector<SlewStation> some;
  auto station = stations.all().lower_bound(*next_);
  for (; station != stations.all().end() && some.size() < kStationsABearing; ++station) {
    some.push_back(station_of(station->first, station->second, now_us));
  }
  next_.reset();
  if (station != stations.all().end()) next_ = station->first;
  return planner_.plan(round_, some, tracks);
}

}  // namespace ols::fusion
