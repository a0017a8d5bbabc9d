// The angle of one axis between the mount's reports: a reported angle plus the axis's rotation
// since the report, which the pictures show. Pure.
//
// It is a Kalman filter. Its state is the angle at the newest report and three causes of
// differences between reports and pictures: an error of time that all reports share; a scale error
// (the mount's gain, the lens's focal length); and a motion of the scene itself (clouds). These
// three can be distinguished only if the mount's rate changes. Their true values change slowly; old
// information about them is therefore gradually forgotten.
//
// The error of a report depends on the reported position. Another report of the same position
// therefore does not improve the angle. Reports of other positions improve the angle only as far as
// their errors actually scatter. The rest of the stated error (backlash, for example) is constant.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace ols::mount {

class CarriedAxis {
 public:
  // A report of the mount.
  struct Report {
    double angle_rad = 0.0;
    // Variance of the angle's error, which depends on the position.
    double place_variance_rad2 = 0.0;
    double time_sd_s = 0.0;         // 1-sigma of the report's time (white)
    double shared_time_sd_s = 0.0;  // 1-sigma of an error that the times of all reports share
  };
  // The axis's rotation at one instant, as the pictures show it (SeenPath::At).
  struct Seen {
    double time_s = 0.0;
    double turned_rad = 0.0, rate_rad_s = 0.0;
    double walk_rad2 = 0.0;  // variance of turned_rad: a random walk that begins with the path
    double bend_rad2 = 0.0;  // additional variance of turned_rad at this instant alone
  };
  struct At {
    double angle_rad, rate_rad_s;
    double variance_rad2;  // without lasting_rad2
    double lasting_rad2;   // variance of the constant error, which does not average out
  };

  // Adds a report and the pictures' rotation at its instant. Call in order of time. A report that
  // contradicts the filter restarts it; the prior for the motion of the scene is then as large as
  // the contradiction.
  void add(const Report& report, const Seen& seen);
  // Call when the pictures' path begins anew, because its rotation has then no relation to the
  // earlier angle.
  void lose_angle() { newest_.reset(); }
  // The angle at the instant of `seen`; nullopt before the first report.
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

  // The pictures' rotation at the newest report, which is the instant of state_.
  std::optional<Seen> newest_;
  Vector state_ = Vector::Zero();
  std::optional<Matrix> covariance_;
  double used_turned_rad_ = 0.0;  // turned_rad at the last report that updated the state
  double place_rad2_ = 0.0;       // place_variance_rad2 of the newest report
  // Mean square of the part of the reports' error that changes from position to position.
  double scatter_rad2_ = 0.0;
};

}  // namespace ols::mount
