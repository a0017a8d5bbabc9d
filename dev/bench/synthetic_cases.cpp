#include "dev/bench/synthetic_cases.h"

#include <cmath>

#include "geometry/angles.h"

namespace ols::bench {
namespace {

constexpr double kRadius_px = 120.0;  // of TargetPath::kCircle
constexpr double kClimb_px = 150.0;   // of TargetPath::kVertical
constexpr double kSwing_px = 200.0;   // of CameraPath::kSwinging, to each side

template <class Set>
void sweep(std::vector<BenchCase>& cases, const BenchCase& base, const char* name,
           const std::vector<double>& values, Set set) {
  for (const double value : values) {
    BenchCase one = base;
    one.sweep = name;
    one.value = value;
    set(one, value);
    cases.push_back(one);
  }
}

void add_properties(std::vector<BenchCase>& cases) {
  const BenchCase base;
  sweep(cases, base, "size", {3, 4, 6, 8, 12, 16, 24, 48, 100, 200},
        [](BenchCase& c, double v) { c.look.width_px = v; });
  sweep(cases, base, "contrast", {3, 5, 7, 10, 15, 20, 40},
        [](BenchCase& c, double v) { c.look.contrast_sigma = v; });
  sweep(cases, base, "blur", {0.4, 0.7, 1.5, 2.5, 4.0},
        [](BenchCase& c, double v) { c.look.blur_px = v; });
  sweep(cases, base, "speed", {0, 40, 100, 300, 600},
        [](BenchCase& c, double v) { c.speed_px_s = v; });
  sweep(cases, base, "growth", {-0.3, -0.1, 0.0, 0.1, 0.3},
        [](BenchCase& c, double v) { c.growth_per_s = v; });
}

void add_camera_motion(std::vector<BenchCase>& cases) {
  BenchCase base;
  base.backdrop = Backdrop::kLandscape;
  base.look.contrast_sigma = 0.0;  // darker than the woods, as it is
  const auto turn = [](BenchCase& c, double v) { c.pan_rate_deg_s = v; };
  sweep(cases, base, "pan_woods", {0, 1, 2, 5, 10, 20}, turn);
  base.angles_given = true;
  sweep(cases, base, "pan_woods_ptu", {0, 1, 2, 5, 10, 20}, turn);
  base.elevation_deg = 30.0;
  base.look = {};
  sweep(cases, base, "pan_clouds_ptu", {0, 1, 2, 5, 10, 20}, turn);
  base.backdrop = Backdrop::kBlankSky;
  base.seconds = 4.0;
  sweep(cases, base, "slew_blank", {5, 10, 20, 30}, turn);
  base.camera_path = CameraPath::kSwinging;
  base.target_path = TargetPath::kStill;
  sweep(cases, base, "swing_blank", {5, 10, 20, 30}, turn);
  base.angles_given = false;
  sweep(cases, base, "swing_blank_alone", {5, 10, 20, 30}, turn);
}

void add_events(std::vector<BenchCase>& cases) {
  BenchCase base;
  base.angles_given = true;
  base.hidden_from_s = 1.0;
  base.seconds = 3.5;
  const auto hurry = [](BenchCase& c, double v) { c.speed_px_s = v; };
  sweep(cases, base, "occlusion_blank", {0, 30, 60, 120}, hurry);
  base.backdrop = Backdrop::kLandscape;
  base.pan_rate_deg_s = 1.0;
  base.elevation_deg = 30.0;
  sweep(cases, base, "occlusion_clouds", {0, 30, 60, 120}, hurry);
  base.elevation_deg = 0.0;
  base.look.contrast_sigma = 0.0;
  sweep(cases, base, "occlusion_woods", {0, 30, 60, 120}, hurry);

  BenchCase skyline;
  skyline.backdrop = Backdrop::kLandscape;
  skyline.on_ridge = true;
  skyline.look.contrast_sigma = 0.0;
  skyline.target_path = TargetPath::kVertical;
  skyline.seconds = 8.0;
  sweep(cases, skyline, "skyline", {60, 120, 240}, hurry);
  sweep(cases, skyline, "skyline_size", {8, 16, 32, 64}, [](BenchCase& c, double v) {
    c.look.width_px = v;
    c.speed_px_s = 80.0;
  });
}

// To and fro between -1 and 1, speed 1.
double triangle(double distance) { return 1.0 - std::abs(std::fmod(distance + 1.0, 4.0) - 2.0); }

}  // namespace

std::vector<BenchCase> bench_cases() {
  std::vector<BenchCase> cases;
  add_properties(cases);
  add_camera_motion(cases);
  add_events(cases);
  return cases;
}

BenchPath::BenchPath(const BenchCase& which, const Landscape& landscape, tracker::Random& random)
    : case_(which), camera_model_(landscape.camera()) {
  axis_.azimuth_rad = 2.0 * kPi * random.uniform();
  axis_.elevation_rad =
      which.on_ridge ? landscape.ridge_rad(axis_.azimuth_rad) : radians(which.elevation_deg);
  phase_rad_ = 2.0 * kPi * random.uniform();
  const double right = random.uniform(), down = random.uniform();
  middle_px_ = {camera_model_.cx_px + 20.0 * (right - 0.5),
                camera_model_.cy_px + 20.0 * (down - 0.5)};
  const Eigen::Vector3d p_cam((middle_px_.x() - camera_model_.cx_px) / camera_model_.fx_px,
                              (middle_px_.y() - camera_model_.cy_px) / camera_model_.fy_px, 1.0);
  stands_enu_ = camera_rotation(axis_) * p_cam;
}

AzimuthElevation BenchPath::camera(double time_s) const {
  AzimuthElevation now = axis_;
  const double turned_rad = radians(case_.pan_rate_deg_s) * time_s;
  if (case_.camera_path == CameraPath::kTurning) {
    now.azimuth_rad += turned_rad;
  } else {
    const double reach_rad = kSwing_px / camera_model_.fx_px / std::cos(axis_.elevation_rad);
    now.azimuth_rad += reach_rad * triangle(turned_rad / reach_rad);
  }
  return now;
}

Eigen::Vector2d BenchPath::target_px(double time_s) const {
  const double travelled = case_.speed_px_s * time_s;
  switch (case_.target_path) {
    case TargetPath::kCircle: {
      const double angle = phase_rad_ + travelled / kRadius_px;
      return middle_px_ + kRadius_px * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    case TargetPath::kVertical:
      // From the sky.
      return middle_px_ + kClimb_px * Eigen::Vector2d(0.2 * std::cos(phase_rad_ + time_s),
                                                      triangle(travelled / kClimb_px + 3.0));
    case TargetPath::kStill:
      break;
  }
  const Eigen::Vector3d p_cam = camera_rotation(camera(time_s)).transpose() * stands_enu_;
  return *project(camera_model_, p_cam);
}

Eigen::Vector2d BenchPath::smear_px(double time_s) const {
  return target_px(time_s + 0.5 * kExposure_s) - target_px(time_s - 0.5 * kExposure_s);
}

bool BenchPath::hidden(double time_s) const {
  return case_.hidden_from_s && time_s >= *case_.hidden_from_s &&
         time_s < *case_.hidden_from_s + kHidden_s;
}

double BenchPath::growth(double time_s) const { return std::exp(case_.growth_per_s * time_s); }

double BenchPath::camera_smear_px() const {
  return radians(case_.pan_rate_deg_s) * kExposure_s * std::cos(axis_.elevation_rad) *
         camera_model_.fx_px;
}

}  // namespace ols::bench
