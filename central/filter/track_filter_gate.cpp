// Bearings that are off: which are set aside, and when they say that the target has done what no
// model allows.
#include <algorithm>
#include <cmath>

#include "central/filter/track_filter.h"
#include "central/measurement/time_span.h"

namespace ols {
namespace {

constexpr int kUpset = 6;  // set-aside bearings in a row, of two stations

}  // namespace

bool TrackFilter::passes_gate(FilterStation& entry, double nis) {
  if (nis <= config_.gate_nis) {
    upset_ = entry.upset = 0;
    two_upset_ = false;
    return true;
  }
  if (upset_ == 0) upset_station_ = entry.station;
  two_upset_ = two_upset_ || upset_station_ != entry.station;
  ++entry.upset;
  if (++upset_ >= kUpset && two_upset_) {
    give_room(config_.motion.acceleration_time_s, Eigen::Matrix3d::Identity());
  } else if (entry.upset % kUpset == 0) {
    give_room_unseen_by_other(entry);
  }
  return false;
}

std::ptrdiff_t TrackFilter::agreed_since(const FilterStation& station) const {
  return std::ranges::count_if(
      stations_, [&](const FilterStation& other) { return other.utime_us > station.utime_us; });
}

// One station alone is always agreed with: the target goes along its ray, and where it has turned
// hard along that, only the other of two stations sees it.
void TrackFilter::give_room_unseen_by_other(const FilterStation& entry) {
  if (entry.used == 0 || agreed_since(entry) != 1) return;
  const auto other = std::ranges::max_element(stations_, {}, &FilterStation::utime_us);
  const Eigen::Vector3d line = (position() - other->sight.origin_ecef).normalized();
  const double since_s = seconds(utime_us_ - entry.utime_us);
  give_room(std::min(since_s, config_.motion.acceleration_time_s), line * line.transpose());
}

// The target has done what no model allows: for so long, any of its accelerations in these
// directions.
void TrackFilter::give_room(double time_s, const Eigen::Matrix3d& along) {
  upset_ = 0;
  two_upset_ = false;
  const double hard = manoeuvre_sd(velocity(), config_.motion);
  const double speed = 2.0 * hard * time_s;
  for (FilterGaussian& model : models_) {
    model.covariance.topLeftCorner<3, 3>() += std::pow(speed * time_s / 2.0, 2) * along;
    model.covariance.block<3, 3>(3, 3) += speed * speed * along;
    model.covariance.block<3, 3>(6, 6) += 4.0 * hard * hard * along;
  }
}

}  // namespace ols
