#include "central/tracking/ray_meetings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "central/measurement/time_span.h"
#include "central/tracking/appearance.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion {

double RayMeetings::moved_rad(double dt_s) const {
  return config_.miss_sigma * config_.rate_sd_rad_s * std::min(1.0, dt_s);
}

// Max angle of a bearing off its target: noise, bias, and motion between the two instants.
double RayMeetings::gate_rad(const BearingMeasurement& measurement, double dt_s, double range_m,
                             const BiasModel& errors) const {
  const BiasPrior bias =
      errors.prior(measurement.station, measurement.sight, std::max(1.0, range_m));
  const double variance =
      (measurement.sight.covariance_white + bias.covariance).trace() / 2.0 +
      std::pow(config_.rate_sd_rad_s * std::min(1.0, dt_s + measurement.clock_sd_s), 2);
  return config_.miss_sigma * std::sqrt(variance);
}

// Where two rays intersect: kOk if they pass near each other in front of both cameras. Pairs that
// the summaries rule out are not computed exactly: that costs ten times as much.
Solution RayMeetings::meet(const LookedAt& a, const LookedAt& b, const BiasModel& errors,
                           RayMeeting& meeting) const {
  const BearingSummary &look = a.look, &other = b.look;
  const Eigen::Vector3d &u = look.direction_ecef, &v = other.direction_ecef;
  const Eigen::Vector3d base = other.origin_ecef - look.origin_ecef;
  constexpr double kOnePlaceM = 0.01;
  const double along = u.dot(v), across = u.cross(v).squaredNorm();
  if (base.norm() < kOnePlaceM) return Solution::kParallelRays;
  if (across < std::pow((look.spread_rad + other.spread_rad) / 2.0, 2)) {
    const double noise_rad =
        gate_rad(a.measurement, 0.0, 1e9, errors) + gate_rad(b.measurement, 0.0, 1e9, errors);
    if (across < noise_rad * noise_rad / 4.0) return Solution::kParallelRays;
  }
  const double s = (base.dot(u) - along * base.dot(v)) / across;
  const double t = (along * base.dot(u) - base.dot(v)) / across;
  if (s <= 0.0 || t <= 0.0) return Solution::kBehindCamera;
  if (std::min(s, t) > max_range_m_) return Solution::kTooFar;
  const Eigen::Vector3d on_a = look.origin_ecef + s * u, on_b = other.origin_ecef + t * v;
  const double dt_s = std::abs(seconds(a.measurement.utime_us - b.measurement.utime_us));
  const double off_m = (on_a - on_b).norm();
  if (off_m > s * (look.spread_rad + moved_rad(dt_s + look.clock_sd_s)) +
                  t * (other.spread_rad + moved_rad(other.clock_sd_s))) {
    return Solution::kRaysMiss;
  }
  const double miss_m =
      s * gate_rad(a.measurement, dt_s, s, errors) + t * gate_rad(b.measurement, 0.0, t, errors);
  if (off_m > miss_m) return Solution::kRaysMiss;
  if (!may_be_same_object(a.measurement, s, b.measurement, t, base.cross(u).normalized()))
    return Solution::kRaysMiss;
  meeting = {(on_a + on_b) / 2.0, std::min(s, t), a.measurement.station, b.measurement.station,
             off_m / miss_m};
  return Solution::kOk;
}

// Among a station's bearings that are near in time to another one: the nearest to the intersection,
// or the latest if there is no intersection. -1: none.
std::ptrdiff_t RayMeetings::nearest(const UnassociatedBearings::Station& own,
                                    const BearingMeasurement& to, const RayMeeting* meeting,
                                    const BiasModel& errors) const {
  std::ptrdiff_t best = -1;
  double least = 1.0;
  for (auto i = std::ssize(own.looks) - 1; i >= 0; --i) {
    const BearingSummary& look = own.looks[static_cast<std::size_t>(i)];
    const double dt_s = std::abs(seconds(look.utime_us - to.utime_us));
    if (dt_s > config_.pair_s && look.utime_us < to.utime_us) break;
    if (dt_s > config_.pair_s) continue;
    if (meeting == nullptr) return i;
    if (!look.is_near(meeting->p_ecef, moved_rad(dt_s + look.clock_sd_s))) continue;
    const BearingMeasurement& measurement = own.bearings[static_cast<std::size_t>(i)];
    const double off = angle_between(look.direction_ecef, meeting->p_ecef - look.origin_ecef) /
                       gate_rad(measurement, dt_s, meeting->range_m, errors);
    if (off >= least) continue;
    least = off;
    best = i;
  }
  return best;
}

bool RayMeetings::may_meet(const BearingMeasurement& a, const BearingMeasurement& b,
                           const BiasModel& errors) const {
  const BearingSummary look = summarise(a, R_ecef_enu(a.sight.origin_ecef));
  const BearingSummary other = summarise(b, R_ecef_enu(b.sight.origin_ecef));
  RayMeeting meeting;
  return meet({a, look}, {b, other}, errors, meeting) == Solution::kOk;
}

std::vector<RayMeeting> RayMeetings::of(const BearingMeasurement& measurement,
                                        const UnassociatedBearings& bearings,
                                        const BiasModel& errors, Solution& failure) const {
  constexpr std::size_t kEnough = 16;
  const BearingSummary look = summarise(measurement, R_ecef_enu(measurement.sight.origin_ecef));
  std::vector<RayMeeting> meetings;
  for (const auto& [station, own] : bearings.stations()) {
    if (station == measurement.station) continue;
    const std::ptrdiff_t latest = nearest(own, measurement, nullptr, errors);
    for (auto i = latest; i >= 0; --i) {
      const auto at = static_cast<std::size_t>(i);
      if (own.looks[at].utime_us < own.looks[static_cast<std::size_t>(latest)].utime_us) break;
      RayMeeting meeting;
      const Solution how =
          meet({measurement, look}, {own.bearings[at], own.looks[at]}, errors, meeting);
      if (how == Solution::kOk) {
        meetings.push_back(std::move(meeting));
      } else {
        failure = how;
      }
    }
  }
  std::ranges::stable_sort(meetings, {}, &RayMeeting::miss);
  if (meetings.size() > kEnough) meetings.erase(meetings.begin() + kEnough, meetings.end());
  for (RayMeeting& meeting : meetings) {
    for (const auto& [third, own] : bearings.stations()) {
      if (third == meeting.first || third == meeting.second) continue;
      meeting.support += nearest(own, measurement, &meeting, errors) >= 0 ? 1 : 0;
    }
  }
  std::ranges::stable_sort(meetings, std::greater<>(), &RayMeeting::support);
  return meetings;
}

}  // namespace ols::fusion
