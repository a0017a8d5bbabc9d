// A simulated tripod for the tests of the stages: draws the pictures of its camera.
#pragma once

#include <memory>

#include "calibration/procedure/landmark_stage.h"
#include "sim/world/renderer.h"

namespace ols::calibration {

class Tripod {
 public:
  // `heading_off_rad`: the error of the heading that the stages get.
  explicit Tripod(double heading_off_rad = 0.0) {
    scenario_.unit_errors = {};
    scenario_.errors.heading.on = scenario_.errors.tilt.on = false;
    scenario_.errors.position.on = scenario_.errors.brightness.on = false;
    world_ = std::make_unique<sim::World>(scenario_, 5);
    renderer_ = std::make_unique<sim::Renderer>(
        *world_, 0, sim::slopes_texture(scenario_.landscape, scenario_.camera));
    model_.geometry = world_->stations()[0].truth;
    model_.geometry.chain.heading_rad += heading_off_rad;
  }

  const StationModel& model() const { return model_; }
  const StationGeometry& truth() const { return world_->stations()[0].truth; }
  std::vector<Landmark> signs(std::size_t n) const {
    std::vector<Landmark> all;
    for (const sim::Mark& mark : scenario_.marks) {
      if (all.size() < n) all.push_back({mark.id, world_->site().to_ecef(mark.p_enu)});
    }
    return all;
  }

  Taken shoot(const Shot& shot) {
    sim::ExposureTruth exposure;
    exposure.exposure_s = 0.002;
    exposure.start = exposure.mid = exposure.end = shot.angles;
    exposure.frame = static_cast<std::uint64_t>(++pose_);
    Taken taken;
    renderer_->draw(exposure, taken.gray);
    taken.angles = shot.angles;
    const double counts = 112000.0 / (2.0 * kPi);
    taken.reading.pan = {shot.angles.pan_rad * counts, 0.0, shot.approach_pan};
    taken.reading.tilt = {shot.angles.tilt_rad * counts, 0.0, shot.approach_tilt};
    taken.pose = pose_;
    taken.utime_us = 1'780'000'000'000'000 + pose_;
    return taken;
  }
  // The pixel of a sign in a picture taken at these angles.
  Eigen::Vector2d place(const Landmark& sign, const PanTilt& angles) const {
    return view(truth(), angles, sign.ecef).value().pixel;
  }

 private:
  sim::Scenario scenario_ = sim::load_scenario(std::string(OLS_SCENARIOS) + "/calibration.toml");
  std::unique_ptr<sim::World> world_;
  std::unique_ptr<sim::Renderer> renderer_;
  StationModel model_;
  std::int64_t pose_ = 0;
};

}  // namespace ols::calibration
