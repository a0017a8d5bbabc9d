// A simulated target's motion: position and velocity over the scenario's time. Pure.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace ols::sim {

struct Motion {
  Eigen::Vector3d p_enu = Eigen::Vector3d::Zero();  // [m] in the site's frame
  Eigen::Vector3d v_enu = Eigen::Vector3d::Zero();  // [m/s]
};

class Trajectory {
 public:
  virtual ~Trajectory() = default;
  virtual Motion at(double time_s) const = 0;
};

// centre + amplitude * sin(2 pi t / period + phase), per axis. The path is a figure-eight if one
// horizontal period is half of the other. It is a circle if both horizontal axes have the same
// period and amplitude, and their phases differ by a quarter of a period.
struct Lissajous final : Trajectory {
  Eigen::Vector3d centre_enu = Eigen::Vector3d::Zero();
  Eigen::Vector3d amplitude_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d period_s = Eigen::Vector3d::Ones();
  Eigen::Vector3d phase_rad = Eigen::Vector3d::Zero();
  Motion at(double time_s) const override;
};

struct Line final : Trajectory {
  Eigen::Vector3d start_enu = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_enu = Eigen::Vector3d::Zero();
  Motion at(double time_s) const override;
};

// Natural cubic spline through points at given times. The target is at rest before the first and
// after the last point.
class Spline final : public Trajectory {
 public:
  // Throws std::invalid_argument for fewer than two points, or times that do not increase.
  Spline(std::vector<double> times_s, std::vector<Eigen::Vector3d> points_enu);
  Motion at(double time_s) const override;

 private:
  std::vector<double> times_s_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector3d> curvature_;  // second derivative at each point
};

// A spline through waypoints. `speed_m_s`: its mean speed on each leg.
std::unique_ptr<Trajectory> through_waypoints(const std::vector<Eigen::Vector3d>& points_enu,
                                              double speed_m_s);

}  // namespace ols::sim
