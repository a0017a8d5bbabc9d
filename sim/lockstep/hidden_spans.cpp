#include "sim/lockstep/hidden_spans.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::sim {
namespace {

using station::StationState;

constexpr double kGlimpse_s = 0.5;  // out for less than this is not out
constexpr double kShortest_s = 1.2;
constexpr double kCoast_s = 0.8;  // until a station that lost its target says so

double made_s(const fusion::OcclusionNotice& notice) {
  return 1e-6 * static_cast<double>(notice.utime_us - Lockstep::kStartUtime_us);
}

std::vector<HiddenSpan> true_spans(const World& world, std::size_t station, double from_s,
                                   double to_s) {
  constexpr double kStep_s = 0.01;
  std::vector<HiddenSpan> spans;
  for (double at_s = from_s; at_s < to_s; at_s += kStep_s) {
    if (!world.hides(station, world.target(0, at_s).p_ecef)) continue;
    const bool goes_on = !spans.empty() && at_s - spans.back().to_s < kGlimpse_s;
    if (!goes_on) {
      HiddenSpan& span = spans.emplace_back();
      span.station = world.stations()[station].id;
      span.from_s = at_s;
    }
    spans.back().to_s = at_s + kStep_s;
  }
  std::erase_if(spans, [&](const HiddenSpan& span) {
    return span.to_s - span.from_s < kShortest_s || span.from_s <= from_s ||
           span.to_s + kGlimpse_s > to_s;
  });
  return spans;
}

JudgedExit judge(const World& world, std::size_t station, double exit_s,
                 const fusion::OcclusionNotice& notice) {
  const fusion::Emergence& exit = *notice.exit;
  const LocalFrame camera(geodetic_from_ecef(world.site().to_ecef(world.camera_enu(station))));
  const AzimuthElevation truth =
      azimuth_elevation_from_enu(camera.to_enu(world.target(0, exit_s).p_ecef));
  const Eigen::Vector2d off(
      wrap_pi(exit.direction.azimuth_rad - truth.azimuth_rad) * std::cos(truth.elevation_rad),
      exit.direction.elevation_rad - truth.elevation_rad);
  return {.ahead_s = exit_s - made_s(notice),
          .error_s = made_s(notice) + exit.in_s - exit_s,
          .sd_s = exit.sd_s,
          .place_nees = off.dot(exit.covariance.inverse() * off) / 2.0,
          .error_rad = off.norm()};
}

void judge_predictions(const World& world, std::size_t station,
                       const std::vector<fusion::OcclusionNotice>& notices, HiddenSpan& span) {
  constexpr double kBegun_s = 0.3, kBefore_s = 0.5;
  const double middle_s = 0.5 * (span.from_s + span.to_s);
  for (const fusion::OcclusionNotice& notice : notices) {
    const double at_s = made_s(notice);
    if (notice.station != span.station || at_s < span.from_s || at_s > span.to_s) continue;
    if (at_s <= middle_s) span.predicted = at_s + notice.holds_s >= middle_s;
    if (!notice.exit || notice.hidden < 0.5) continue;
    if (!span.first && at_s > span.from_s + kBegun_s) {
      span.first = judge(world, station, span.to_s, notice);
    }
    if (at_s < span.to_s - kBefore_s) span.last = judge(world, station, span.to_s, notice);
  }
}

void judge_states(const std::vector<FrameNote>& frames, HiddenSpan& span) {
  for (const FrameNote& frame : frames) {
    if (frame.mid_s >= span.to_s && frame.state == StationState::kTracking) {
      span.found_s = frame.mid_s - span.to_s;
      return;
    }
    if (frame.mid_s < span.from_s + kCoast_s || frame.mid_s >= span.to_s) continue;
    ++span.frames;
    if (frame.state == StationState::kLost) ++span.lost;
    if (frame.state == StationState::kSlewed) ++span.slewed;
    if (frame.state == StationState::kHidden) ++span.hidden;
  }
}

}  // namespace

std::vector<HiddenSpan> hidden_spans(const World& world, const LockstepResult& result) {
  std::vector<HiddenSpan> all;
  for (std::size_t i = 0; i < result.stations.size(); ++i) {
    const auto& frames = result.stations[i].frames;
    if (frames.empty() || result.designated_s < 0.0) continue;
    const double from_s = std::max(result.designated_s, frames.front().mid_s) + 1.0;
    for (HiddenSpan& span : true_spans(world, i, from_s, frames.back().mid_s)) {
      judge_predictions(world, i, result.occlusions, span);
      judge_states(frames, span);
      all.push_back(std::move(span));
    }
  }
  return all;
}

}  // namespace ols::sim
