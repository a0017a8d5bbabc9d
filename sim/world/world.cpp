#include "sim/world/world.h"

#include <cmath>
#include <random>

#include "sim/world/sighted_landmarks.h"

namespace ols::sim {
namespace {

// Draws every error even if it is off, so that a switch changes only its own error.
class ErrorSource {
 public:
  explicit ErrorSource(std::uint64_t seed) : generator_(seed) {}
  double operator()(const Errors::Switch& error, double sd) {
    const double drawn = normal_(generator_);
    return error.on ? sd * drawn : 0.0;
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

CalibrationSd stated_sd(const Errors& e) {
  CalibrationSd sd;
  if (e.heading.on) sd.heading_rad = e.heading.sd_rad;
  if (e.tilt.on) sd.tilt_rad = e.tilt.sd_rad;
  if (e.mounting.on) sd.mount_rad = e.mounting.sd_rad;
  if (e.mounting.on) sd.mount_roll_rad = e.mounting.roll_sd_rad;
  if (e.position.on) sd.position_m = e.position.sd_m;
  return sd;
}

constexpr std::uint64_t kUnitErrorsTag = 11000, kZoomTag = 12000;

// At the wide end; what the calibration leaves of the lens is drawn apart from all else.
void mount_zoom(const StationScenario& scenario, double px_per_mm, std::uint64_t seed,
                StationTruth& station) {
  const ZoomScenario& zoom = scenario.zoom;
  if (zoom.is_fixed()) return;
  CameraIntrinsics widest = undistorted(station.truth.camera);
  widest.fx_px = widest.fy_px = zoom.range_mm[0] * px_per_mm;
  station.zoom.emplace(widest, zoom.range_mm[1] / zoom.range_mm[0]);
  station.zoom_points = station.zoom->calibrated(zoom.focal_sd, seed);
  station.truth.camera = widest;
  station.nominal.camera = station.zoom_points.front().camera;
}

// A configuration without a calibration knows the unit as its data sheet does.
void state_unit(const UnitErrorsScenario& errors, StationGeometry& nominal) {
  if (errors.size == UnitErrors::kNone) return;
  const MountSize size = stated_mount(errors, nominal.camera);
  nominal.sd.mount_rad = std::hypot(nominal.sd.mount_rad, size.across_rad);
  nominal.sd.mount_roll_rad = std::hypot(nominal.sd.mount_roll_rad, size.roll_rad);
}

StationGeometry nominal_geometry(const Scenario& s, const StationScenario& station,
                                 const LocalFrame& site) {
  StationGeometry g;
  g.position = geodetic_from_ecef(site.to_ecef(station.p_enu));
  g.chain = station.chain;
  g.camera = s.camera_of(station);
  g.sd = stated_sd(s.errors);
  if (!s.errors.distortion.on) g.camera = undistorted(g.camera);
  return g;
}

StationGeometry true_geometry(const StationGeometry& nominal, const Errors& e, ErrorSource& draw) {
  StationGeometry g = nominal;
  g.sd = {};
  g.chain.heading_rad += draw(e.heading, e.heading.sd_rad);
  g.chain.tilt_x_rad += draw(e.tilt, e.tilt.sd_rad);
  g.chain.tilt_y_rad += draw(e.tilt, e.tilt.sd_rad);
  g.chain.mount_z_rad += draw(e.mounting, e.mounting.sd_rad);
  g.chain.mount_y_rad += draw(e.mounting, e.mounting.sd_rad);
  g.chain.mount_x_rad += draw(e.mounting, e.mounting.roll_sd_rad);
  Eigen::Vector3d shift_enu;
  for (double& axis : shift_enu) axis = draw(e.position, e.position.sd_m);
  g.position = geodetic_from_ecef(LocalFrame(nominal.position).to_ecef(shift_enu));
  g.camera.k1 += draw(e.distortion, e.distortion.residual_k1_sd);
  return g;
}

}  // namespace

World::World(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario), seed_(seed), site_(scenario.origin) {
  const Errors& e = scenario_.errors;
  for (std::size_t i = 0; i < scenario_.stations.size(); ++i) {
    ErrorSource draw(derived_seed(seed, i));
    StationTruth station;
    station.id = scenario_.stations[i].id;
    station.nominal = nominal_geometry(scenario_, scenario_.stations[i], site_);
    station.truth = true_geometry(station.nominal, e, draw);
    station.unit = draw_unit(scenario_.unit_errors, derived_seed(seed, kUnitErrorsTag + i),
                             station.truth.chain, station.truth.camera);
    state_unit(scenario_.unit_errors, station.nominal);
    mount_zoom(scenario_.stations[i], scenario_.px_per_mm, derived_seed(seed, kZoomTag + i),
               station);
    station.clock_offset_s = draw(e.clock, e.clock.sd_s);
    station.clock_sd_s = e.clock.on ? e.clock.sd_s : 0.0;
    station.brightness_gain = 1.0 + draw(e.brightness, e.brightness.gain_sd);
    stations_.push_back(station);
  }
  if (scenario_.stationing.by != StationingBy::kDrawn) {
    const double step_rad = radians(ptu_unit_config().resolution_arcsec / 3600.0);
    find_headings(scenario_, seed, step_rad, stations_);
  }
  if (!scenario_.relief.is_flat()) relief_.emplace(scenario_.relief);
  for (const StationTruth& station : stations_) {
    cameras_enu_.push_back(site_.to_enu(camera_centre_ecef(station.truth, {})));
  }
}

bool World::hides(std::size_t station, const Eigen::Vector3d& p_ecef) const {
  return relief_ && relief_->hides(cameras_enu_.at(station), site_.to_enu(p_ecef));
}

TargetTruth World::target(std::size_t index, double time_s) const {
  const Motion motion = scenario_.targets.at(index).trajectory->at(time_s);
  return {site_.to_ecef(motion.p_enu), site_.R_ecef_enu() * motion.v_enu};
}

PtuUnitConfig World::ptu_unit_config() const {
  // A switched-off encoder has a sixteenth of the default step.
  const Errors& e = scenario_.errors;
  const double standard = PtuUnitConfig{}.resolution_arcsec;
  const double step = e.encoder.on ? e.encoder.step_arcsec : standard / 16.0;
  const auto scaled = [&](int counts) {
    return static_cast<int>(std::lround(counts * standard / step));
  };
  PtuUnitConfig c;
  c.resolution_arcsec = step;
  c.pan_min_counts = scaled(c.pan_min_counts);
  c.pan_max_counts = scaled(c.pan_max_counts);
  c.tilt_min_counts = scaled(c.tilt_min_counts);
  c.tilt_max_counts = scaled(c.tilt_max_counts);
  c.max_speed_counts_s = scaled(c.max_speed_counts_s);
  c.min_speed_counts_s = scaled(c.min_speed_counts_s);
  c.base_speed_counts_s = scaled(c.base_speed_counts_s);
  c.acceleration_counts_s2 = scaled(c.acceleration_counts_s2);
  c.baud = scenario_.ptu.baud;
  c.home_at_power_up = scenario_.ptu.home_at_power_up;
  c.reply_jitter_s = e.ptu_reply.on ? e.ptu_reply.jitter_s : 0.0;
  return c;
}

}  // namespace ols::sim
