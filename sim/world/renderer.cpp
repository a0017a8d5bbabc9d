#include "sim/world/renderer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "sim/scenario/normal.h"

namespace ols::sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kNoiseStrip = std::size_t{1} << 21;
// Light in 16 bits, in 64ths of a gray level; maximum gain and noise still fit.
constexpr int kLevelBits = 6, kLevel = 1 << kLevelBits;
constexpr double kUnitGain = 16384.0, kGreatestGain = 1.4;
constexpr double kLandSeen_m = 3000.0;
constexpr std::uint64_t kPanoramaTag = 1000, kNoiseTag = 2000;

// Axes of a level body that flies along v: x forward, y left, z up.
Matrix3d level_body(const Vector3d& v_enu) {
  const double course = v_enu.head<2>().norm() > 1e-6 ? std::atan2(v_enu.y(), v_enu.x()) : 0.0;
  return Eigen::AngleAxisd(course, Vector3d::UnitZ()).toRotationMatrix();
}

// Of a bird: the longer its wings, the slower they beat (about 4 Hz for a crow).
double wing_rad(double span_m, double time_s) {
  constexpr double kBeat_m_s = 3.5, kStroke_rad = 0.7;
  return kStroke_rad * std::sin(2.0 * kPi * kBeat_m_s / span_m * time_s);
}

Eigen::Isometry3d camera_pose(const StationTruth& station, const PanTilt& angles) {
  if (station.unit.exact) return enu_from_camera(station.truth.chain, angles);
  return camera_on(station.truth.chain, station.unit.trunnion_rad, angles);
}

// A target's position in the camera frame at an instant.
Vector3d in_camera(const World& world, const StationTruth& station, std::size_t target,
                   double time_s, const PanTilt& angles) {
  const LocalFrame local(station.truth.position);
  const Vector3d p_enu = local.to_enu(world.target(target, time_s).p_ecef);
  return camera_pose(station, angles).inverse() * p_enu;
}

std::optional<FlyerView> flyer_view(const World& world, const StationTruth& station,
                                    std::size_t target, const ExposureTruth& exposure) {
  const CameraIntrinsics camera = camera_of(station, exposure);
  const Vector3d p_cam = in_camera(world, station, target, exposure.mid_s, exposure.mid);
  const auto centre = project(camera, p_cam);
  if (!centre) return std::nullopt;
  const TargetScenario& scenario = world.scenario().targets[target];
  const LocalFrame local(station.truth.position);
  const Vector3d v_enu =
      local.R_ecef_enu().transpose() * world.target(target, exposure.mid_s).v_ecef;
  const Matrix3d R_cam_enu = camera_pose(station, exposure.mid).linear().transpose();
  FlyerView view;
  view.centre_px = *centre;
  view.px_per_m = project_jacobian(camera, p_cam) * R_cam_enu * level_body(v_enu);
  view.shape = scenario.shape;
  view.span_m = scenario.span_m;
  view.wing_rad = wing_rad(scenario.span_m, exposure.mid_s);
  view.brightness = scenario.brightness;
  const double half_s = 0.5 * exposure.exposure_s;
  const auto first =
      project(camera, in_camera(world, station, target, exposure.mid_s - half_s, exposure.start));
  const auto last =
      project(camera, in_camera(world, station, target, exposure.mid_s + half_s, exposure.end));
  if (first && last && world.scenario().errors.motion_blur.on) view.smear_px = *last - *first;
  return view;
}

// A box filter of fractional length, odd number of taps.
cv::Mat box_kernel(double length_px) {
  const int half = static_cast<int>(std::ceil(0.5 * (length_px - 1.0)));
  cv::Mat kernel(1, 2 * half + 1, CV_32F, cv::Scalar(1.0 / length_px));
  const double ends = 0.5 * (length_px - (2 * half - 1));
  kernel.at<float>(0) = kernel.at<float>(2 * half) = static_cast<float>(ends / length_px);
  return kernel;
}

// 16-bit arithmetic throughout, which compilers vectorise.
void develop_row(const std::vector<std::uint16_t>& column_gain, std::uint16_t falloff,
                 const std::int16_t* __restrict noise, std::uint8_t* __restrict out) {
  const std::uint16_t* __restrict gain = column_gain.data();
  const std::size_t columns = column_gain.size();
  for (std::size_t x = 0; x < columns; ++x) {
    const auto bright = static_cast<std::uint16_t>(out[x] << 8);
    const auto dimmed = static_cast<std::uint16_t>(gain[x] - falloff);
    const auto light = static_cast<std::uint16_t>((std::uint32_t{bright} * dimmed) >> 16);
    const auto noisy = static_cast<std::int16_t>(light + noise[x] + (1 << (kLevelBits - 1)));
    const auto level = static_cast<std::int16_t>(noisy >> kLevelBits);
    const std::int16_t positive = std::max<std::int16_t>(level, 0);
    out[x] = static_cast<std::uint8_t>(std::min<std::int16_t>(positive, 255));
  }
}

}  // namespace

CameraIntrinsics camera_of(const StationTruth& station, const ExposureTruth& exposure) {
  return station.zoom ? station.zoom->camera_at(exposure.zoom) : station.truth.camera;
}

ViewTruth view_truth(const World& world, std::size_t station, const ExposureTruth& exposure,
                     std::size_t target) {
  const StationTruth& truth = world.stations()[station];
  const auto view = flyer_view(world, truth, target, exposure);
  if (!view) return {};
  const CameraIntrinsics camera = camera_of(truth, exposure);
  const Eigen::Vector2d& c = view->centre_px;
  const bool hidden = world.hides(station, world.target(target, exposure.mid_s).p_ecef);
  const bool inside = !hidden && c.x() >= -0.5 && c.y() >= -0.5 && c.x() < camera.width_px - 0.5 &&
                      c.y() < camera.height_px - 0.5;
  // Of the three directions in space, the one along the line of sight does not count.
  return {inside, c, flyer_box(*view), view->px_per_m.norm() / std::sqrt(2.0)};
}

std::vector<std::unique_ptr<Renderer>> make_renderers(const World& world) {
  const cv::Mat slopes = slopes_texture(world.scenario().landscape, world.scenario().camera);
  std::vector<std::unique_ptr<Renderer>> renderers;
  for (std::size_t i = 0; i < world.stations().size(); ++i) {
    renderers.push_back(std::make_unique<Renderer>(world, i, slopes));
  }
  return renderers;
}

Renderer::Renderer(const World& world, std::size_t station, const cv::Mat& slopes)
    : world_(world),
      station_(station),
      panorama_(world.scenario().landscape, world.stations()[station].truth.camera, slopes,
                // The landscape belongs to the scenario, not to the run.
                derived_seed(static_cast<std::uint64_t>(world.scenario().landscape.seed),
                             kPanoramaTag + station)),
      boards_(world.scenario().boards, world.stations()[station].truth.chain,
              world.stations()[station].unit.trunnion_rad) {
  if (const Relief* relief = world.relief()) {
    panorama_.raise([&](double azimuth_rad) {
      const Eigen::Vector2d outward(std::sin(azimuth_rad), std::cos(azimuth_rad));
      return std::atan(relief->highest_slope(world.camera_enu(station), outward, kLandSeen_m));
    });
  }
  const Errors& e = world.scenario().errors;
  const CameraIntrinsics& camera = world.stations()[station].truth.camera;
  noise_.resize(kNoiseStrip, 0);
  if (e.noise.on) {
    std::mt19937_64 generator(derived_seed(world.seed(), kNoiseTag + station));
    Normal<double> normal;
    for (auto& n : noise_) {
      n = static_cast<std::int16_t>(std::clamp(e.noise.sd_gray * kLevel * normal(generator),
                                               -120.0 * kLevel, 120.0 * kLevel));
    }
  }
  // Brightness falls with the square of the distance from the centre: a sum of two squares.
  const double corner2 = 0.25 * (std::pow(camera.width_px, 2) + std::pow(camera.height_px, 2));
  const double falloff = e.brightness.on ? e.brightness.vignetting / corner2 : 0.0;
  const double gain =
      kUnitGain * std::clamp(world.stations()[station].brightness_gain, 0.2, kGreatestGain);
  for (int x = 0; x < camera.width_px; ++x) {
    column_gain_.push_back(static_cast<std::uint16_t>(
        std::lround(gain * (1.0 - falloff * std::pow(x - camera.cx_px, 2)))));
  }
  for (int y = 0; y < camera.height_px; ++y) {
    row_falloff_.push_back(
        static_cast<std::uint16_t>(std::lround(gain * falloff * std::pow(y - camera.cy_px, 2))));
  }
}

ViewTruth Renderer::draw(const ExposureTruth& exposure, cv::Mat& gray) {
  draw_scene(exposure, gray);
  draw_sky_light(exposure, gray);
  develop(exposure, gray);
  return view_truth(world_, station_, exposure);
}

void Renderer::draw_scene(const ExposureTruth& exposure, cv::Mat& gray) {
  const StationTruth& truth = world_.stations()[station_];
  const Eigen::Isometry3d pose = camera_pose(truth, exposure.mid);
  const CameraIntrinsics camera = camera_of(truth, exposure);
  if (truth.zoom) panorama_.set_camera(camera);
  panorama_.draw(pose.linear(), gray);
  draw_marks(exposure, gray);
  boards_.put_up(exposure.by_hand, camera, exposure.mid);
  boards_.draw(camera, pose, gray);
  if (world_.scenario().errors.motion_blur.on) smear(exposure, gray);
  for (std::size_t target = 0; target < world_.scenario().targets.size(); ++target) {
    const auto view = flyer_view(world_, truth, target, exposure);
    if (!view) continue;
    FlyerMatte matte = flyer_matte(*view, gray.size());
    if (world_.relief()) cover(exposure, world_.target(target, exposure.mid_s).p_ecef, matte);
    draw_flyer(matte, gray);
  }
}

void Renderer::cover(const ExposureTruth& exposure, const Eigen::Vector3d& target_ecef,
                     FlyerMatte& matte) const {
  const StationTruth& truth = world_.stations()[station_];
  const CameraIntrinsics camera = camera_of(truth, exposure);
  const Matrix3d R_enu_cam = camera_pose(truth, exposure.mid).linear();
  const Vector3d camera_enu = world_.camera_enu(station_);
  const double distance_m = (world_.site().to_enu(target_ecef) - camera_enu).head<2>().norm();
  for (int x = 0; x < matte.area.width; ++x) {
    std::optional<double> highest;  // of the whole column: the camera is nearly level
    for (int y = 0; y < matte.area.height; ++y) {
      const auto ray = unproject(camera, Eigen::Vector2d(matte.area.x + x, matte.area.y + y));
      if (!ray) continue;
      const Vector3d enu = R_enu_cam * *ray;
      const double level = enu.head<2>().norm();
      if (!highest) {
        highest = world_.relief()->highest_slope(camera_enu, enu.head<2>() / level, distance_m);
      }
      if (enu.z() / level < *highest) matte.colour(y, x) = matte.covered(y, x) = 0.0F;
    }
  }
}

// The sun, and the filter that a person has put on because of it.
void Renderer::draw_sky_light(const ExposureTruth& exposure, cv::Mat& gray) const {
  const bool filtered = exposure.by_hand.sun_filter;
  if (filtered) draw_filter(gray);
  if (!exposure.sun) return;
  const StationTruth& truth = world_.stations()[station_];
  const CameraIntrinsics camera = camera_of(truth, exposure);
  const Eigen::Matrix3d R_cam_enu = camera_pose(truth, exposure.mid).linear().transpose();
  const auto seen = project(camera, R_cam_enu * exposure.sun->enu);
  if (seen) draw_sun(*seen, exposure.sun->radius_rad * camera.fx_px, filtered, gray);
}

void Renderer::draw_marks(const ExposureTruth& exposure, cv::Mat& gray) const {
  const StationTruth& truth = world_.stations()[station_];
  const CameraIntrinsics camera = camera_of(truth, exposure);
  for (const Mark& mark : world_.scenario().marks) {
    const Vector3d p_cam =
        camera_pose(truth, exposure.mid).inverse() *
        LocalFrame(truth.truth.position).to_enu(world_.site().to_ecef(mark.p_enu));
    const auto seen = project(camera, p_cam);
    if (seen) draw_mark(*seen, 0.5 * mark.size_m / p_cam.z() * camera.fx_px, gray);
  }
}

void Renderer::smear(const ExposureTruth& exposure, cv::Mat& gray) const {
  StationGeometry truth = world_.stations()[station_].truth;
  truth.camera = camera_of(world_.stations()[station_], exposure);
  const Matrix3d H = rotation_homography(truth, exposure.start, exposure.end);
  const Vector3d centre(truth.camera.cx_px, truth.camera.cy_px, 1.0);
  const Eigen::Vector2d motion = (H * centre).hnormalized() - centre.head<2>();
  // Along one axis after the other: exact for a pan or a tilt.
  constexpr double kNoticed = 0.7;  // [px] below this the lens blurs more
  const double along_x = std::max(1.0, std::abs(motion.x()));
  const double along_y = std::max(1.0, std::abs(motion.y()));
  if (motion.cwiseAbs().maxCoeff() < kNoticed) return;
  cv::sepFilter2D(gray, gray, -1, box_kernel(along_x), box_kernel(along_y));
}

void Renderer::develop(const ExposureTruth& exposure, cv::Mat& gray) const {
  if (std::abs(exposure.light - 1.0) > 1e-6)
    gray.convertTo(gray, -1, exposure.light);  // it saturates
  const std::uint64_t seed = derived_seed(world_.seed(), kNoiseTag + station_);
  const std::size_t places = noise_.size() - column_gain_.size();
  for (int y = 0; y < gray.rows; ++y) {
    const auto row = static_cast<std::size_t>(y);
    develop_row(column_gain_, row_falloff_[row],
                noise_.data() + derived_seed(seed + exposure.frame, row) % places, gray.ptr(y));
  }
}

}  // namespace ols::sim
