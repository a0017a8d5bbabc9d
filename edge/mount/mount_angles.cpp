#include "edge/mount/mount_angles.h"

namespace ols::mount {
namespace {

// Whether they differ by more than their errors: then the pictures show something that moves.
bool contradict(const AngleAt& a, const AngleAt& b) {
  constexpr double kMost = 9.0;  // in variances
  const Eigen::Array2d off(a.angles.pan_rad - b.angles.pan_rad,
                           a.angles.tilt_rad - b.angles.tilt_rad);
  const Eigen::Array2d variances = (a.covariance + a.lasting_covariance + b.covariance).diagonal();
  return (off.square() > kMost * variances).any();
}

}  // namespace

bool MountAngles::add(const AngleSample& sample) {
  if (!reported_.add(sample)) return false;
  carried_.add(sample);
  return true;
}

void MountAngles::clear() {
  reported_.clear();
  carried_.clear();
}

std::optional<AngleAt> MountAngles::at(double time_s, double stamp_sd_s) const {
  auto reported = reported_.at(time_s);
  auto carried = carried_.at(time_s);
  if (!reported) return carried;
  const Eigen::Vector2d rate(reported->rate.pan_rad, reported->rate.tilt_rad);
  reported->covariance += rate * rate.transpose() * (stamp_sd_s * stamp_sd_s);
  // The covariance by reports alone contains their error of place.
  const bool surer =
      carried &&
      (carried->covariance + carried->lasting_covariance).trace() < reported->covariance.trace() &&
      !contradict(*carried, *reported);
  if (!surer) return reported;
  carried->interpolated = reported->interpolated;
  return carried;
}

}  // namespace ols::mount
