#include "central/tracking/loss_watch.h"

#include <algorithm>
#include <cmath>

#include "central/measurement/activity.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

constexpr double kStep_s = 0.05;      // between the moments of a trail
constexpr double kLongest_s = 10.0;   // of a loss
constexpr double kShortest_s = 0.25;  // shorter ones may be lost messages
constexpr double kMoved_m = 5.0;      // of the camera: other things hide what is behind them

struct Look {
  LostPlaces::Cell cell;
  double distance_m = 0.0;
};

Look look(const LocalFrame& camera, const Eigen::Vector3d& p_ecef) {
  const Eigen::Vector3d enu = camera.to_enu(p_ecef);
  return {LostPlaces::cell_of(azimuth_elevation_from_enu(enu)), enu.norm()};
}

}  // namespace

LossWatch::Station& LossWatch::station_of(const BearingMeasurement& measurement) {
  Station& station = stations_[measurement.station];
  const Eigen::Vector3d& camera_ecef = measurement.sight.origin_ecef;
  if ((station.camera_ecef - camera_ecef).norm() > kMoved_m) station = {camera_ecef, {}};
  return station;
}

// A station that follows another target meanwhile has not lost this one.
void LossWatch::note_attention(const BearingMeasurement& measurement, std::int64_t track_id) {
  if (measurement.is_tracklet) return;
  for (auto& [id, trail] : trails_) {
    const auto sight = trail.by_station.find(measurement.station);
    if (id != track_id && sight != trail.by_station.end()) sight->second.left_for_another = true;
  }
}

// At the azimuths where the station last saw the target and saw it again, it counts as seen.
void LossWatch::judge_loss(const Trail& trail, const Sight& before, const Sight& after,
                           const std::string& name, Station& station, const Visible& visible) {
  constexpr double kSurelyVisible = 0.9;
  const LocalFrame camera(geodetic_from_ecef(station.camera_ecef));
  std::map<int, Look> highest;  // at each azimuth
  std::int64_t last_us = before.utime_us;
  for (const Moment& moment : trail.moments) {
    if (moment.utime_us <= before.utime_us || moment.utime_us >= after.utime_us) continue;
    if (seconds(moment.utime_us - last_us) > Activity::kContributesS) return;
    last_us = moment.utime_us;
    if (visible(name, station.camera_ecef, moment.p_ecef, moment.covariance_ecef) < kSurelyVisible)
      return;
    const Look at = look(camera, moment.p_ecef);
    if (at.cell.azimuth == before.cell.azimuth || at.cell.azimuth == after.cell.azimuth) continue;
    auto& passed = highest.try_emplace(at.cell.azimuth, at).first->second;
    if (at.cell.elevation > passed.cell.elevation) passed = at;
  }
  if (seconds(after.utime_us - last_us) > Activity::kContributesS) return;
  for (const auto& [azimuth, at] : highest) station.places.lost(at.cell, at.distance_m);
}

void LossWatch::note(const BearingMeasurement& measurement, const Track& track,
                     const Visible& visible) {
  const std::int64_t now_us = measurement.utime_us;
  Station& station = station_of(measurement);
  Trail& trail = trails_[track.id];
  const KinematicState there = track.filter.at(now_us);
  const bool is_known = seconds(now_us - track.last_two_station_us) < Activity::kDeliversS;
  auto& moments = trail.moments;
  if (is_known && (moments.empty() || seconds(now_us - moments.back().utime_us) >= kStep_s))
    moments.push_back({now_us, there.mean.head<3>(), there.covariance.topLeftCorner<3, 3>()});
  while (!moments.empty() && seconds(now_us - moments.front().utime_us) > kLongest_s)
    moments.pop_front();
  const LocalFrame camera(geodetic_from_ecef(station.camera_ecef));
  const Look at = look(camera, there.mean.head<3>());
  const Sight sight{now_us, at.cell};
  note_attention(measurement, track.id);
  const auto [found, is_first] = trail.by_station.try_emplace(measurement.station, sight);
  Sight& before = found->second;
  const double unseen_s = seconds(now_us - before.utime_us);
  if (unseen_s < 0.0) return;
  if (is_first || at.cell != before.cell) station.places.seen(at.cell, at.distance_m);
  const bool is_loss = unseen_s > kShortest_s && unseen_s < kLongest_s && !before.left_for_another;
  if (is_loss) judge_loss(trail, before, sight, measurement.station, station, visible);
  before = sight;
}

const LostPlaces* LossWatch::of(const std::string& station,
                                const Eigen::Vector3d& camera_ecef) const {
  const auto found = stations_.find(station);
  if (found == stations_.end() || !found->second.places.may_hide()) return nullptr;
  const bool is_there = (found->second.camera_ecef - camera_ecef).norm() <= kMoved_m;
  return is_there ? &found->second.places : nullptr;
}

double LossWatch::hidden(const std::string& station, const Eigen::Vector3d& camera_ecef,
                         const Eigen::Vector3d& p_ecef) const {
  const LostPlaces* const places = of(station, camera_ecef);
  if (places == nullptr) return 0.0;
  const Eigen::Vector3d enu = LocalFrame(geodetic_from_ecef(camera_ecef)).to_enu(p_ecef);
  return places->probability(azimuth_elevation_from_enu(enu), enu.norm());
}

std::vector<std::pair<std::string, LostPlace>> LossWatch::places() const {
  std::vector<std::pair<std::string, LostPlace>> all;
  for (const auto& [name, station] : stations_) {
    for (const LostPlace& place : station.places.places()) all.emplace_back(name, place);
  }
  return all;
}

void LossWatch::keep_only(const std::vector<Track>& tracks) {
  std::erase_if(trails_, [&](const auto& trail) {
    return std::ranges::find(tracks, trail.first, &Track::id) == tracks.end();
  });
}

void LossWatch::forget(const std::string& station) {
  stations_.erase(station);
  for (auto& [id, trail] : trails_) trail.by_station.erase(station);
}

}  // namespace ols::fusion
