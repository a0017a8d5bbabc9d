#include "calibration/name_stars.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/calibration/star_scene.h"

namespace ols::calibration {
namespace {

using test::night_sky;
using test::NightSky;

Problem nameless(const NightSky& sky) {
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {sky.station};
  for (const StarFrame& frame : sky.frames) {
    for (const Eigen::Vector2d& pixel : frame.pixels) {
      Observation one;
      one.kind = Kind::kStar;
      one.utime_us = frame.utime_us;
      one.reading = frame.reading;
      one.pixel = pixel;
      one.sd_px = 0.3;
      problem.observations.push_back(one);
    }
  }
  return problem;
}

// Named, the false ones left out, they are a calibration.
TEST(NameStars, MakesACalibrationOfNamelessStars) {
  const NightSky sky = night_sky(1002);
  Problem problem = nameless(sky);
  const NamedStars named = name_stars(problem);
  EXPECT_EQ(named.remarks.size(), 1U);
  EXPECT_EQ(named.false_ones.size(), 15U);
  std::size_t i = 0;
  for (const auto& frame : sky.stars) {
    for (const std::int32_t hip : frame) {
      const std::string expected = hip == 0 ? "" : "HIP " + std::to_string(hip);
      EXPECT_EQ(problem.observations[i++].reference, expected);
    }
  }
  std::erase_if(problem.observations, [](const Observation& one) { return one.reference.empty(); });
  const Calibration found = calibrate(Adjustment(network_of(problem)));
  const double heading_rad = found.fit.state.stations[0].model.geometry.chain.heading_rad;
  EXPECT_NEAR(wrap_pi(heading_rad - sky.truth.geometry.chain.heading_rad), 0.0, 0.01);
}

// Half a thousandth of focal length, where the workshop knows a tenth of that: both the stars and
// the adjustment say so, and neither does where the lens was left alone.
TEST(NameStars, ALensThatWasRefocusedIsNamedByTheAdjustment) {
  for (const double change : {0.0, 5e-4}) {
    NightSky sky = night_sky(1002, {.frames = 12});
    CameraIntrinsics& camera = sky.station.model.geometry.camera;
    sky.station.covariance(kFocal, kFocal) = std::pow(5e-5 * camera.fx_px, 2);
    sky.station.covariance(kK1, kK1) = std::pow(0.005, 2);
    camera.k1 = sky.truth.geometry.camera.k1;
    camera.fx_px = (1.0 + change) * sky.truth.geometry.camera.fx_px;
    camera.fy_px = (1.0 + change) * sky.truth.geometry.camera.fy_px;
    Problem problem = nameless(sky);
    name_stars(problem);
    std::erase_if(problem.observations,
                  [](const Observation& one) { return one.reference.empty(); });
    const Calibration found = calibrate(Adjustment(network_of(problem)));
    const bool named = std::ranges::any_of(found.remarks, [](const std::string& remark) {
      return remark.find("was the lens refocused?") != std::string::npos;
    });
    EXPECT_EQ(named, change != 0.0) << change;
  }
}

TEST(NameStars, SaysWhyTheyStayUnknown) {
  NightSky sky = night_sky(1002);
  sky.station.model.geometry.position.latitude_rad *= -1.0;
  Problem problem = nameless(sky);
  EXPECT_THAT([&] { name_stars(problem); },
              testing::ThrowsMessage<StarsUnidentified>(
                  testing::HasSubstr("the stars are those of latitude 49.20")));
}

// A star of the table needs no row of its own.
TEST(NameStars, TakesThePlacesOfTheTable) {
  Problem problem = nameless(night_sky(1002));
  for (Observation& one : problem.observations) one.reference = "HIP 11767";
  name_stars(problem);
  EXPECT_TRUE(std::holds_alternative<Star>(problem.references.at("HIP 11767")));
}

}  // namespace
}  // namespace ols::calibration
