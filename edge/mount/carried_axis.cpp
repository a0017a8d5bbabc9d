#include "edge/mount/carried_axis.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kUnknown_rad = 1.0;  // 1-sigma of an angle before its first report
constexpr double kScale_sd = 0.02;
constexpr double kScene_sd_rad_s = radians(0.1);
constexpr double kScaleKept_s = 300.0, kSceneKept_s = 20.0;  // time constants
constexpr double kContradiction = 16.0;                      // in variances
// 1-sigma of what lens, parallax and corners add that does not show: units that report more
// exactly need no pictures.
constexpr double kUnmodelled_rad = radians(0.005);
constexpr double kSmoothing = 0.05;  // of the scatter, for each report

double square(double x) { return x * x; }

}  // namespace

CarriedAxis::Vector CarriedAxis::prior_variance(const Report& report) {
  return {square(kUnknown_rad), square(report.shared_time_sd_s), square(kScale_sd),
          square(kScene_sd_rad_s)};
}

// Keeps time, scale and scene.
void CarriedAxis::begin(const Report& report) {
  if (!covariance_) covariance_ = prior_variance(report).asDiagonal();
  state_(kAngle) = report.angle_rad;
  covariance_->row(kAngle).setZero();
  covariance_->col(kAngle).setZero();
  (*covariance_)(kAngle, kAngle) = square(kUnknown_rad);
}

void CarriedAxis::restart(const Report& report, double scene_rad_s) {
  state_.setZero();
  covariance_.reset();
  begin(report);
  (*covariance_)(kScene, kScene) += square(scene_rad_s);
}

void CarriedAxis::advance(const Report& report, const Seen& seen) {
  const double turned_rad = seen.turned_rad - newest_->turned_rad;
  const double passed_s = seen.time_s - newest_->time_s;
  const double scale_kept = std::exp(-passed_s / kScaleKept_s);
  const Vector kept(1.0, scale_kept, scale_kept, std::exp(-passed_s / kSceneKept_s));
  Matrix F = kept.asDiagonal();
  F(kAngle, kScale) = turned_rad;
  F(kAngle, kScene) = passed_s;
  state_ = F * state_;
  state_(kAngle) += turned_rad;
  *covariance_ = F * *covariance_ * F.transpose();
  covariance_->diagonal() +=
      (1.0 - kept.array().square()).matrix().cwiseProduct(prior_variance(report));
  (*covariance_)(kAngle, kAngle) += std::max(0.0, seen.walk_rad2 - newest_->walk_rad2);
}

bool CarriedAxis::is_elsewhere(const Seen& seen) const {
  return square(seen.turned_rad - used_turned_rad_) > place_rad2_;
}

void CarriedAxis::learn_scatter(double off_rad, double explained_rad2) {
  scatter_rad2_ += kSmoothing * (off_rad * off_rad - explained_rad2 - scatter_rad2_);
}

void CarriedAxis::add(const Report& report, const Seen& seen) {
  const bool begins = !newest_;
  const double passed_s = begins ? 0.0 : seen.time_s - newest_->time_s;
  place_rad2_ = report.place_variance_rad2;
  if (begins) {
    begin(report);
  } else {
    advance(report, seen);
  }
  newest_ = seen;
  const Vector H(1.0, seen.rate_rad_s, 0.0, 0.0);
  const double white_rad2 = square(seen.rate_rad_s * report.time_sd_s) + seen.bend_rad2;
  double off_rad = report.angle_rad - H.dot(state_);
  const double explained_rad2 = H.dot(*covariance_ * H) + white_rad2;
  const bool contradicts =
      !begins && square(off_rad) > kContradiction * (explained_rad2 + place_rad2_);
  const bool elsewhere = is_elsewhere(seen);
  if (contradicts) {
    restart(report, off_rad / passed_s);
    off_rad = 0.0;
  } else if (!begins && elsewhere) {
    learn_scatter(off_rad, explained_rad2);
  }
  const double noise_rad2 = white_rad2 + place_rad2_;
  if (!begins && !elsewhere && (*covariance_)(kAngle, kAngle) < noise_rad2) return;
  const Vector gain = *covariance_ * H / (H.dot(*covariance_ * H) + noise_rad2);
  state_ += gain * off_rad;
  const Matrix rest = Matrix::Identity() - gain * H.transpose();
  *covariance_ = rest * *covariance_ * rest.transpose() + gain * noise_rad2 * gain.transpose();
  used_turned_rad_ = seen.turned_rad;
}

std::optional<CarriedAxis::At> CarriedAxis::at(const Seen& seen) const {
  if (!newest_) return std::nullopt;
  const double turned_rad = seen.turned_rad - newest_->turned_rad;
  const Vector H(1.0, 0.0, turned_rad, seen.time_s - newest_->time_s);
  const double constant_rad2 = std::clamp(place_rad2_ - scatter_rad2_, 0.0, place_rad2_);
  // Of the state's variance, as much may come from the part that lasts; it counts once.
  const double counted_rad2 = std::min(constant_rad2, (*covariance_)(kAngle, kAngle));
  return At{H.dot(state_) + turned_rad, (1.0 + state_(kScale)) * seen.rate_rad_s + state_(kScene),
            std::max(0.0, H.dot(*covariance_ * H) - counted_rad2) +
                std::abs(seen.walk_rad2 - newest_->walk_rad2) + seen.bend_rad2,
            square(kUnmodelled_rad) + constant_rad2};
}

}  // namespace ols::mount
