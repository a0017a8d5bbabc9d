// The angle of one axis, carried from the mount's reports to other instants by the turns that the
// pictures show. Pure.
//
// A Kalman filter. Besides the angle at the newest report it estimates the causes of differences
// between reports and pictures: the error of the time that all reports share; the scale (the
// mount's gain, the lens's focal length); the motion of the scene itself (clouds). Only a changing
// rate distinguishes these. Their values wander, so they are slowly forgotten.
//
// A report's error depends on the reported place. Another report of the same place therefore does
// not improve the angle. Reports of other places improve it only as far as they are seen to
// scatter. The rest of the stated error (backlash, for example) lasts.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ols::mount {

class CarriedAxis {
 public:
  // What the mount reports.
  struct Report {
    double angle_rad = 0.0;
    double place_variance_rad2 = 0.0;  // error of the angle, which depends on the place
    double time_sd_s = 0.0;            // 1-sigma of the instant (white)
    double shared_time_sd_s = 0.0;     // 1-sigma of an error that the instants of all reports share
  };
  // What the pictures show at one instant.
  struct Seen {
    double time_s = 0.0;
    double turned_rad = 0.0, rate_rad_s = 0.0;
    double walk_rad2 = 0.0;  // variance of turned_rad, a random walk from the path's beginning
    double bend_rad2 = 0.0;  // variance of turned_rad at this instant alone
  };
  struct At {
    double angle_rad, rate_rad_s;
    double variance_rad2;  // without the part that lasts
    double lasting_rad2;   // does not average out
  };

  // The report of an instant, in order of time. A report that contradicts the filter restarts it:
  // the scene is then taken to move as fast as the contradiction shows.
  void add(const Report& report, const Seen& seen);
  // Call when the pictures' path begins anew: nothing connects it with the angle so far.
  void lose_angle() { newest_.reset(); }
  // nullopt before the first report.
  std::optional<At> at(const Seen& seen) const;
  std::optional<double> newest_s() const {
    return newest_ ? std::optional(newest_->time_s) : std::nullopt;
  }

 private:
  enum State { kAngle, kTime, kScale, kScene };  // [rad], [s], relative, [rad/s]
  using Vector = Eigen::Vector4d;
  using Matrix = Eigen::Matrix4d;

  static Vector prior_variance(const Report& report);
  void begin(const Report& report);
  void advance(const Report& report, const Seen& seen);
  void restart(const Report& report, double scene_rad_s);
  void learn_scatter(double off_rad, double explained_rad2);
  bool is_elsewhere(const Seen& seen) const;

  std::optional<Seen> newest_;  // at the newest report, for which the state holds
  Vector state_ = Vector::Zero();
  std::optional<Matrix> covariance_;
  double used_turned_rad_ = 0.0;  // at the last report that changed the state
  double place_rad2_ = 0.0;       // as last stated
  double scatter_rad2_ = 0.0;     // mean square difference of the reports from place to place
};

}  // namespace ols::mount
