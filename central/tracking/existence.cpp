#include "central/tracking/existence.h"

#include <algorithm>
#include <cmath>

#include "central/measurement/time_span.h"
#include "geometry/angles.h"
#include "geometry/wgs84.h"

namespace ols::fusion {
namespace {

constexpr double kShown = 0.8, kByChance = 0.4;
constexpr double kMostLogOdds = 7.0;  // so that a change shows within some images

double angle_of(const AzimuthElevation& a, const AzimuthElevation& b) {
  return angle_between(enu_from_azimuth_elevation(a), enu_from_azimuth_elevation(b));
}

}  // namespace

void Existence::seen() {
  log_odds_ = std::min(log_odds_ + std::log(kShown / kByChance), kMostLogOdds);
}

void Existence::missed(double visible) {
  const double by = std::log((1.0 - kShown * visible) / (1.0 - kByChance * visible));
  log_odds_ = std::max(log_odds_ + by, -kMostLogOdds);
}

double Existence::probability() const {
  return is_judged_ ? 1.0 / (1.0 + std::exp(-log_odds_)) : 1.0;
}

void StationViews::know(const std::string& station, const AzimuthElevation& axis, double view_rad,
                        std::int64_t utime_us) {
  constexpr double kSteady = 0.02;  // of the field of view
  View& own = views_[station];
  const bool is_steady = own.utime_us != 0 && angle_of(own.axis, axis) <= kSteady * view_rad;
  own = {axis, view_rad, utime_us, is_steady};
}

bool StationViews::shows(const BearingMeasurement& in_image, const Eigen::Vector3d& p_ecef) const {
  constexpr double kOldestS = 2.0, kWellInside = 0.45;
  const auto found = views_.find(in_image.station);
  if (found == views_.end()) return false;
  const View& view = found->second;
  const double age_s = std::abs(seconds(in_image.utime_us - view.utime_us));
  if (!view.is_steady || age_s > kOldestS) return false;
  const Eigen::Vector3d& camera = in_image.sight.origin_ecef;
  const Eigen::Vector3d there = R_ecef_enu(camera).transpose() * (p_ecef - camera);
  return angle_between(there, enu_from_azimuth_elevation(view.axis)) <= kWellInside * view.view_rad;
}

}  // namespace ols::fusion
