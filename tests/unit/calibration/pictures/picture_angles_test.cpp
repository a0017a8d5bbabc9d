#include "calibration/pictures/picture_angles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angles.h"
#include "sim/world/renderer.h"

namespace ols::calibration {
namespace {

// Whatever a mount reports, the pictures say how far it has turned.
TEST(PictureAngles, TheyAreThoseOfTheCameraWhateverIsReported) {
  sim::Scenario scenario = sim::load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
  scenario.camera.width_px = 640;
  scenario.camera.height_px = 480;
  scenario.camera.cx_px = 319.5;
  scenario.camera.cy_px = 239.5;
  scenario.landscape.ridge_mean_rad = radians(25.0);
  scenario.landscape.ridge_relief_rad = 0.0;
  scenario.errors.brightness.on = scenario.errors.motion_blur.on = false;
  const sim::World world(scenario, 3);
  const auto slopes = sim::slopes_texture(scenario.landscape, scenario.camera);
  sim::Renderer renderer(world, 0, slopes);
  std::vector<TurnedPicture> pictures;
  std::vector<PanTilt> truth;
  std::int64_t frame = 0;
  const auto add = [&](double pan_deg, double tilt_deg, double gain, bool moves) {
    sim::ExposureTruth exposure;
    truth.push_back({radians(pan_deg), radians(tilt_deg)});
    exposure.exposure_s = 0.002;
    exposure.start = exposure.mid = exposure.end = truth.back();
    exposure.frame = ++frame;
    TurnedPicture picture{{}, {gain * truth.back().pan_rad, truth.back().tilt_rad}, moves};
    renderer.draw(exposure, picture.gray);
    pictures.push_back(picture);
  };
  for (const double gain : {1.06, -0.9}) {
    pictures.clear();
    truth.clear();
    for (const double pan_deg : {0.0, -0.3, 0.1, 0.5}) add(pan_deg, 1.5, gain, false);
    add(0.5, 1.2, gain, false);
    for (const double pan_deg : {-0.2, 0.25, 0.4}) add(pan_deg, 1.5, gain, true);
    add(20.0, 1.5, gain, false);  // nothing in common
    const PictureAngles found = angles_of_pictures(world.stations()[0].truth, pictures);
    EXPECT_LT(found.rms_px, 0.3);
    EXPECT_FALSE(found.angles.back());
    for (std::size_t i = 0; i + 1 < pictures.size(); ++i) {
      SCOPED_TRACE(i);
      ASSERT_TRUE(found.angles[i]);
      const PanTilt first = pictures.front().reported;
      EXPECT_NEAR(found.angles[i]->pan_rad - first.pan_rad, truth[i].pan_rad - truth[0].pan_rad,
                  3e-5);
      EXPECT_NEAR(found.angles[i]->tilt_rad - first.tilt_rad, truth[i].tilt_rad - truth[0].tilt_rad,
                  3e-5);
    }
  }
}

}  // namespace
}  // namespace ols::calibration
