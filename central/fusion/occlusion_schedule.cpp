#include "central/fusion/occlusion_schedule.h"

#include <algorithm>
#include <cmath>

#include "geometry/slew_limits.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

constexpr double kStep_s = 0.1;
constexpr int kSteps = 120;
// The land model is wrong by some metres, so a target may vanish earlier than expected.
constexpr double kLead_s = 1.0;

std::vector<Position> path_of(const Track& track, const PathSpread& spread, std::int64_t now_us) {
  std::vector<Position> path;
  for (int i = 0; i < kSteps; ++i) {
    const double lead_s = kStep_s * i;
    const KinematicState state = track.filter.at(now_us + std::llround(1e6 * lead_s));
    path.push_back(
        {state.mean.head<3>(), spread.factor(lead_s) * state.covariance.topLeftCorner<3, 3>()});
  }
  return path;
}

// A notice is valid until the target has surely reappeared, and until the next notice has arrived.
double holds_for(const Occlusion& occlusion) {
  constexpr double kNext_s = 0.5, kLongest_s = kOcclusionHolds_s, kSigmas = 3.0;
  if (!occlusion.exit) return kNext_s;
  return std::min(kLongest_s, occlusion.exit->in_s + kSigmas * occlusion.exit->sd_s + kNext_s);
}

}  // namespace

LandHorizon& OcclusionSchedule::horizon_of(Told& told, const Eigen::Vector3d& camera_ecef) const {
  constexpr double kMoved_m = 1.0;  // more than a camera moves on its mount
  const auto& horizon = told.horizon;
  if (!horizon || (horizon->frame().origin_ecef() - camera_ecef).norm() > kMoved_m) {
    told.horizon = std::make_unique<LandHorizon>(surface_, geodetic_from_ecef(camera_ecef));
  }
  return *told.horizon;
}

std::vector<OcclusionNotice> OcclusionSchedule::plan(
    std::int64_t now_us, const std::vector<Slew>& slews, const StationRegistry& stations,
    const std::vector<Track>& tracks, const SeenSkylines& skylines, const LossWatch& losses) {
  std::vector<OcclusionNotice> notices;
  if (!surface_) return notices;
  std::erase_if(spreads_, [&](const auto& one) {
    return std::ranges::find(tracks, one.first, &Track::id) == tracks.end();
  });
  std::map<std::int64_t, std::vector<Position>> paths;
  for (const Slew& slew : slews) {
    const auto track = std::ranges::find(tracks, slew.target_id, &Track::id);
    const auto station = stations.all().find(slew.station);
    if (slew.target_id == 0 || track == tracks.end() || station == stations.all().end()) continue;
    auto& path = paths[slew.target_id];
    if (path.empty()) {
      PathSpread& spread = spreads_[slew.target_id];
      spread.note(track->filter, now_us);
      path = path_of(*track, spread, now_us);
    }
    Told& told = told_[slew.station];
    const Eigen::Vector3d& camera_ecef = station->second.traits.camera_ecef;
    const auto occlusion = occlusion_ahead(
        horizon_of(told, camera_ecef), path, kStep_s, kLead_s,
        {skylines.of(slew.station, camera_ecef), losses.of(slew.station, camera_ecef)});
    if (!occlusion && now_us >= told.exit_us) continue;
    OcclusionNotice notice{slew.station, now_us, slew.target_id};
    if (occlusion) {
      notice.hidden = occlusion->hidden;
      notice.exit = occlusion->exit;
      notice.holds_s = holds_for(*occlusion);
      const double exit_in_s = occlusion->exit ? occlusion->exit->in_s : notice.holds_s;
      told.exit_us = now_us + std::llround(1e6 * exit_in_s);
    }
    notices.push_back(std::move(notice));
  }
  return notices;
}

}  // namespace ols::fusion
