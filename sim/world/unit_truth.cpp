#include "sim/world/unit_truth.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/scenario/seeds.h"

namespace ols::sim {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kTwoPi = 2.0 * EIGEN_PI;
constexpr double kArcsec = EIGEN_PI / 648000.0;
constexpr int kTeeth = 70;         // of the worm wheels
constexpr int kCountsOfAWave = 4;  // microsteps of a full step

// 1-sigma of each: arc seconds, pixels, shares.
struct Sizes {
  double mount, roll, trunnion, eccentricity, worm, slack;
  double focal, aspect, centre_px, k1, k2, exposure_s;
};
constexpr Sizes kNewUnit{360, 720, 60, 40, 10, 20, 3e-3, 1e-4, 20.0, 0.05, 0.5, 2e-3};
constexpr Sizes kWorkshopUnit{30, 30, 4, 5, 5, 5, 1e-4, 2e-5, 0.5, 0.005, 0.05, 2e-4};

const Sizes& sizes(UnitErrors size) { return size == UnitErrors::kNew ? kNewUnit : kWorkshopUnit; }

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}
  double operator()(double sd) { return sd * normal_(generator_); }
  double phase() { return std::uniform_real_distribution<double>(0.0, kTwoPi)(generator_); }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

ShaftTruth draw_shaft(const UnitErrorsScenario& scenario, bool is_pan, Draw& draw) {
  const Sizes& s = sizes(scenario.size);
  ShaftTruth shaft;
  shaft.cos1_rad = draw(s.eccentricity * kArcsec);
  shaft.sin1_rad = draw(s.eccentricity * kArcsec);
  if (is_pan) {
    shaft.cos2_rad = draw(s.eccentricity * kArcsec);
    shaft.sin2_rad = draw(s.eccentricity * kArcsec);
  }
  shaft.worm_cos_rad = draw(s.worm * kArcsec);
  shaft.worm_sin_rad = draw(s.worm * kArcsec);
  shaft.second_worm_rad = scenario.second_worm_arcsec * kArcsec;
  shaft.second_worm_phase = draw.phase();
  shaft.wave_rad = scenario.wave_arcsec * kArcsec;
  shaft.wave_phase = draw.phase();
  shaft.slack_rad = std::abs(draw(s.slack * kArcsec));
  return shaft;
}

void draw_camera(const Sizes& s, Draw& draw, CameraIntrinsics& camera) {
  camera.fx_px *= 1.0 + draw(s.focal);
  camera.fy_px = camera.fx_px * (1.0 + draw(s.aspect));
  camera.cx_px += draw(s.centre_px);
  camera.cy_px += draw(s.centre_px);
  camera.k1 += draw(s.k1);
  camera.k2 += draw(s.k2);
}

Eigen::Matrix3d turn(double angle_rad, const Vector3d& axis) {
  return AngleAxisd(angle_rad, axis).toRotationMatrix();
}

// A standard normal number that belongs to a count.
double noise_of(std::uint64_t seed, std::int64_t count) {
  constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
  const std::uint64_t bits = derived_seed(seed, static_cast<std::uint64_t>(count));
  const double u = (static_cast<double>(bits >> 11) + 0.5) * kScale;
  const double v = static_cast<double>(derived_seed(bits, 1) >> 11) * kScale;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(kTwoPi * v);
}

// The motor moves, and takes the shaft with it at the end of the slack.
double follow_axis(double behind_rad, double way_rad, double slack_rad) {
  return std::clamp(behind_rad + way_rad, -0.5 * slack_rad, 0.5 * slack_rad);
}

}  // namespace

UnitTruth draw_unit(const UnitErrorsScenario& scenario, std::uint64_t seed, ChainParameters& chain,
                    CameraIntrinsics& camera) {
  UnitTruth unit;
  if (scenario.size == UnitErrors::kNone) return unit;
  Draw draw(seed);
  const Sizes& s = sizes(scenario.size);
  unit.exact = false;
  unit.pan = draw_shaft(scenario, true, draw);
  unit.tilt = draw_shaft(scenario, false, draw);
  unit.trunnion_rad = draw(s.trunnion * kArcsec);
  unit.exposure_offset_s = draw(s.exposure_s);
  unit.jitter_rad = scenario.jitter_arcsec * kArcsec;
  unit.jitter_seed = derived_seed(seed, 1);
  chain.mount_z_rad += draw(s.mount * kArcsec);
  chain.mount_y_rad += draw(s.mount * kArcsec);
  chain.mount_x_rad += draw(s.roll * kArcsec);
  draw_camera(s, draw, camera);
  return unit;
}

MountSize stated_mount(const UnitErrorsScenario& scenario, const CameraIntrinsics& camera) {
  if (scenario.size == UnitErrors::kNone) return {};
  const Sizes& s = sizes(scenario.size);
  const double gears = std::hypot(1.5 * s.eccentricity, s.worm);
  return {std::hypot(std::hypot(s.mount, gears) * kArcsec, s.centre_px / camera.fx_px),
          s.roll * kArcsec};
}

Eigen::Isometry3d camera_on(const ChainParameters& c, double trunnion_rad, const PanTilt& shafts) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  // Heading is clockwise from north, and X of ORIGIN is zero pan.
  const Eigen::Matrix3d origin =
      turn(0.5 * EIGEN_PI - c.heading_rad, z) * turn(c.tilt_x_rad, x) * turn(c.tilt_y_rad, y);
  const Eigen::Matrix3d pan = origin * turn(shafts.pan_rad, z);
  const Eigen::Matrix3d tilt = pan * turn(trunnion_rad, x) * turn(-shafts.tilt_rad, y);
  const Eigen::Matrix3d mount =
      tilt * turn(c.mount_z_rad, z) * turn(c.mount_x_rad, x) * turn(c.mount_y_rad, y);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = c.ground_to_origin_m + origin * c.origin_to_azi_m + pan * c.azi_to_ele_m +
                       tilt * c.ele_to_focus_m + mount * c.focus_to_camera_m;
  // Right, down and forward of the picture.
  pose.linear().col(0) = -mount.col(1);
  pose.linear().col(1) = -mount.col(2);
  pose.linear().col(2) = mount.col(0);
  return pose;
}

UnitMechanics::UnitMechanics(const UnitTruth& truth, double count_rad)
    : truth_(truth), count_rad_(count_rad), counts_per_turn_(std::round(kTwoPi / count_rad)) {}

void UnitMechanics::follow(const PanTilt& counted) {
  if (truth_.exact) return;
  if (!followed_) newest_ = counted;
  followed_ = true;
  behind_.pan_rad =
      follow_axis(behind_.pan_rad, counted.pan_rad - newest_.pan_rad, truth_.pan.slack_rad);
  behind_.tilt_rad =
      follow_axis(behind_.tilt_rad, counted.tilt_rad - newest_.tilt_rad, truth_.tilt.slack_rad);
  newest_ = counted;
}

PanTilt UnitMechanics::shafts(const PanTilt& counted) const {
  if (truth_.exact) return counted;
  return {shaft(truth_.pan, counted.pan_rad, behind_.pan_rad, 1),
          shaft(truth_.tilt, counted.tilt_rad, behind_.tilt_rad, 2)};
}

PanTilt UnitMechanics::shafts_from(const PanTilt& counted, int side_pan, int side_tilt) const {
  if (truth_.exact) return counted;
  return {shaft(truth_.pan, counted.pan_rad, 0.5 * side_pan * truth_.pan.slack_rad, 1),
          shaft(truth_.tilt, counted.tilt_rad, 0.5 * side_tilt * truth_.tilt.slack_rad, 2)};
}

double UnitMechanics::shaft(const ShaftTruth& axis, double counted_rad, double slack_rad,
                            std::uint64_t tag) const {
  const double count = counted_rad / count_rad_;
  const double t = kTwoPi * count / counts_per_turn_;
  double angle = t - slack_rad;
  angle += axis.cos1_rad * std::cos(t) + axis.sin1_rad * std::sin(t);
  angle += axis.cos2_rad * std::cos(2.0 * t) + axis.sin2_rad * std::sin(2.0 * t);
  angle += axis.worm_cos_rad * std::cos(kTeeth * t) + axis.worm_sin_rad * std::sin(kTeeth * t);
  angle += axis.second_worm_rad * std::sin(2.0 * kTeeth * t + axis.second_worm_phase);
  angle += axis.wave_rad * std::sin(kTwoPi * count / kCountsOfAWave + axis.wave_phase);
  const auto whole = static_cast<std::int64_t>(std::llround(count));
  return angle + truth_.jitter_rad * noise_of(derived_seed(truth_.jitter_seed, tag), whole);
}

}  // namespace ols::sim
