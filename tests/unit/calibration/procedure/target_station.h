// A station in front of its rectification targets: a unit with errors (sim/world/unit_truth.h),
// whose camera takes pictures of boards that are not exactly in their places.
#pragma once

#include <random>

#include "calibration/procedure/target_reader.h"
#include "geometry/angles.h"
#include "sim/world/unit_truth.h"
#include "tests/unit/calibration/target_scene.h"

namespace ols::calibration::test {

inline constexpr double kArcsec_rad = kPi / 648000.0;

class TargetStation {
 public:
  explicit TargetStation(std::uint64_t seed, sim::UnitErrors size = sim::UnitErrors::kNew)
      : random_(static_cast<unsigned>(seed)) {
    model_.geometry.camera = truth_camera_ = half_size_camera();
    model_.geometry.chain.heading_rad = truth_chain_.heading_rad = radians(30.0);
    sim::UnitErrorsScenario scenario;
    scenario.size = size;
    unit_ = sim::draw_unit(scenario, seed, truth_chain_, truth_camera_);
    // Also halves the error of the principal point, because the picture has half the size.
    truth_camera_.cx_px = 319.5 + 0.5 * (truth_camera_.cx_px - 319.5);
    truth_camera_.cy_px = 239.5 + 0.5 * (truth_camera_.cy_px - 239.5);
    mechanics_ = std::make_unique<sim::UnitMechanics>(unit_, 2.0 * kPi / 112000.0);
    truth_chain_.tilt_x_rad = normal(100.0 * kArcsec_rad);
    truth_chain_.tilt_y_rad = normal(100.0 * kArcsec_rad);
    level_.kind = Kind::kInclinometer;
    level_.tilt_rad = {truth_chain_.tilt_x_rad + normal(41.0 * kArcsec_rad),
                       truth_chain_.tilt_y_rad + normal(41.0 * kArcsec_rad)};
    level_.tilt_sd_rad = 5e-6;
    level_.zero_sd_rad = 41.0 * kArcsec_rad;
  }

  const StationModel& model() const { return model_; }
  const Observation& level() const { return level_; }
  double normal(double sd) { return sd * std::normal_distribution<double>()(random_); }

  // A point ahead of the unit at zero pan. `right_m`, `up_m`: from the intersection of the axes.
  Eigen::Vector3d ahead(double away_m, double right_m, double up_m) const {
    const double a = truth_chain_.heading_rad;
    const Eigen::Vector3d forward(std::sin(a), std::cos(a), 0.0);
    const Eigen::Vector3d right(forward.y(), -forward.x(), 0.0);
    return axes() + away_m * forward + right_m * right + up_m * Eigen::Vector3d::UnitZ();
  }
  // A board at ahead(...) that faces the unit, then turned about the vertical and rolled by these
  // angles.
  Board board(double away_m, double right_m, double up_m, double turned_rad, double rolled_rad) {
    Board board;
    board.middle = ahead(away_m, right_m, up_m);
    const Eigen::Vector3d forward = (ahead(1.0, 0.0, 0.0) - axes()).normalized();
    const Eigen::Vector3d level(forward.y(), -forward.x(), 0.0);
    const Eigen::Vector3d right = std::cos(turned_rad) * level + std::sin(turned_rad) * forward;
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    board.right = std::cos(rolled_rad) * right + std::sin(rolled_rad) * up;
    board.up = std::cos(rolled_rad) * up - std::sin(rolled_rad) * right;
    return board;
  }
  // A board with level lines, turned about the vertical by 2 degrees (1-sigma).
  Board level_board(double rolled_rad) {
    Board one = board(30.0, 0.0, 0.05, normal(radians(2.0)), rolled_rad);
    one.gray = lines_on(4.0, 3.0, 0.5, 0.04);
    return one;
  }
  // An upright board whose horizontal edges are parallel to the tilt axis with the unit at these
  // angles. `off_m`: the error of its sideways position.
  Board cross_board(const CrossBoard& stated, double off_m, const PanTilt& counted) const {
    Board one;
    const Eigen::Isometry3d head = head_at(counted);
    one.right = -head.linear().col(1);
    one.up = Eigen::Vector3d::UnitZ();
    one.right = (one.right - one.right.z() * one.up).normalized();
    one.middle = head * Eigen::Vector3d(stated.distance_m, -(stated.apart_m + off_m), 0.0);
    one.gray = crosses_on(stated.apart_m, stated.arm_m, stated.width_m);
    return one;
  }
  std::vector<Board> rulers(const RulerPair& stated, double far_zero_off_m) {
    Board near = board(stated.near_m, -0.3, 0.1, 0.0, 0.0);
    Board far = board(stated.far_m, 0.6, 0.1 + far_zero_off_m, 0.0, 0.0);
    near.gray = far.gray = ruler_on(stated.bar_m, 0.2, 16);
    return {near, far};
  }

  Taken shoot(const Shot& shot, const std::vector<Board>& boards, const Conditions& conditions) {
    Taken taken;
    const double count = 2.0 * kPi / 112000.0;
    const PanTilt counted{std::round(shot.angles.pan_rad / count) * count,
                          std::round(shot.angles.tilt_rad / count) * count};
    const PanTilt shafts = mechanics_->shafts_from(counted, shot.approach_pan, shot.approach_tilt);
    Conditions own = conditions;
    own.seed = static_cast<unsigned>(random_());
    taken.gray = picture_of(truth_camera_, sim::camera_on(truth_chain_, unit_.trunnion_rad, shafts),
                            boards, own);
    taken.angles = counted;
    taken.reading.pan = {counted.pan_rad / count, 0.0, shot.approach_pan};
    taken.reading.tilt = {counted.tilt_rad / count, 0.0, shot.approach_tilt};
    taken.pose = ++pose_;
    taken.utime_us = 1'780'000'000'000'000 + pose_;
    return taken;
  }

  // The three rectification angles at these counts, computed from the truth alone.
  double roll(const PanTilt& counted, int side) const {
    const Eigen::Matrix3d R = camera(counted, side).linear();
    return std::atan2(-R(2, 0), -R(2, 1));
  }
  double azimuth(const PanTilt& counted) const {
    const Eigen::Vector3d ray =
        head_at(counted).linear().transpose() * camera(counted, 1).linear() * middle();
    return std::atan2(-ray.y(), std::hypot(ray.x(), ray.z()));
  }
  double elevation(const PanTilt& counted, int side) const {
    const Eigen::Vector3d ray = camera(counted, side).linear() * middle();
    return std::atan2(ray.z(), ray.head<2>().norm()) - counted.tilt_rad;
  }

 private:
  Eigen::Vector3d axes() const {
    return truth_chain_.ground_to_origin_m + truth_chain_.origin_to_azi_m;
  }
  Eigen::Vector3d middle() const { return unproject(truth_camera_, {319.5, 239.5}).value(); }
  Eigen::Isometry3d camera(const PanTilt& counted, int side) const {
    return sim::camera_on(truth_chain_, unit_.trunnion_rad,
                          mechanics_->shafts_from(counted, side, side));
  }
  // The pose of the unit's head without its camera: X ahead, Y along the tilt axis.
  Eigen::Isometry3d head_at(const PanTilt& counted) const {
    ChainParameters bare = truth_chain_;
    bare.mount_z_rad = bare.mount_x_rad = bare.mount_y_rad = 0.0;
    bare.ele_to_focus_m.setZero();
    bare.focus_to_camera_m.setZero();
    Eigen::Isometry3d head =
        sim::camera_on(bare, unit_.trunnion_rad, mechanics_->shafts_from(counted, 1, 1));
    Eigen::Matrix3d from_camera;  // OpenCV's axes: x right, y down, z ahead
    from_camera << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    head.linear() = head.linear() * from_camera;
    return head;
  }

  std::mt19937 random_;
  StationModel model_;
  CameraIntrinsics truth_camera_;
  ChainParameters truth_chain_;
  sim::UnitTruth unit_;
  std::unique_ptr<sim::UnitMechanics> mechanics_;
  Observation level_;
  std::int64_t pose_ = 0;
};

}  // namespace ols::calibration::test
