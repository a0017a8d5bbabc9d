#include "sim/world/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace ols::sim {
namespace {

Scenario fig7() { return load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml"); }

// The pixel that shows a point 300 m away differs between told and true geometry by this much.
double disagreement_px(const StationTruth& station) {
  const LocalFrame local(station.nominal.position);
  const Eigen::Vector3d p_ecef = local.to_ecef({200.0, 200.0, 80.0});
  const PanTilt angles = aim_at(station.nominal, p_ecef).value();
  const Eigen::Vector2d off_axis(20.0, 20.0);  // so that roll and distortion show
  const auto told = aim_at(station.nominal, p_ecef, off_axis).value_or(angles);
  return (view(station.truth, told, p_ecef).value().pixel -
          view(station.nominal, told, p_ecef).value().pixel)
      .norm();
}

void switch_all_off(Errors& e) {
  for (Errors::Switch* error :
       {static_cast<Errors::Switch*>(&e.heading), static_cast<Errors::Switch*>(&e.tilt),
        static_cast<Errors::Switch*>(&e.mounting), static_cast<Errors::Switch*>(&e.position),
        static_cast<Errors::Switch*>(&e.distortion), static_cast<Errors::Switch*>(&e.clock)}) {
    error->on = false;
  }
}

TEST(World, WithoutErrorsToldAndTrueAgree) {
  Scenario s = fig7();
  switch_all_off(s.errors);
  const World world(s, 3);
  for (const StationTruth& station : world.stations()) {
    EXPECT_LT(disagreement_px(station), 1e-6);
    EXPECT_EQ(station.clock_offset_s, 0.0);
    EXPECT_EQ(station.nominal.sd.heading_rad, 0.0);
  }
}

TEST(World, EachErrorShowsOnItsOwn) {
  const std::vector<std::function<Errors::Switch&(Errors&)>> switches = {
      [](Errors& e) -> Errors::Switch& { return e.heading; },
      [](Errors& e) -> Errors::Switch& { return e.tilt; },
      [](Errors& e) -> Errors::Switch& { return e.mounting; },
      [](Errors& e) -> Errors::Switch& { return e.position; },
      [](Errors& e) -> Errors::Switch& { return e.distortion; }};
  for (std::size_t i = 0; i < switches.size(); ++i) {
    Scenario s = fig7();
    switch_all_off(s.errors);
    switches[i](s.errors).on = true;
    const World world(s, 3);
    for (const StationTruth& station : world.stations()) {
      EXPECT_GT(disagreement_px(station), 2e-3) << "error " << i;
    }
  }
}

TEST(World, ASwitchLeavesTheOtherErrorsAsTheyWere) {
  Scenario s = fig7();
  const World all(s, 5);
  s.errors.heading.on = false;
  const World without(s, 5);
  const ChainParameters& a = all.stations()[1].truth.chain;
  const ChainParameters& b = without.stations()[1].truth.chain;
  EXPECT_NE(a.heading_rad, b.heading_rad);
  EXPECT_EQ(a.tilt_x_rad, b.tilt_x_rad);
  EXPECT_EQ(a.mount_y_rad, b.mount_y_rad);
  EXPECT_EQ(all.stations()[1].clock_offset_s, without.stations()[1].clock_offset_s);
}

TEST(World, ErrorsHaveTheStatedSpread) {
  const Scenario s = fig7();
  double heading = 0.0, clock = 0.0, position = 0.0;
  int drawn = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const World world(s, seed);
    for (const StationTruth& t : world.stations()) {
      heading += std::pow(t.truth.chain.heading_rad - t.nominal.chain.heading_rad, 2);
      clock += std::pow(t.clock_offset_s, 2);
      position += (ecef_from_geodetic(t.truth.position) - ecef_from_geodetic(t.nominal.position))
                      .squaredNorm();
      ++drawn;
    }
  }
  EXPECT_NEAR(std::sqrt(heading / drawn) / s.errors.heading.sd_rad, 1.0, 0.08);
  EXPECT_NEAR(std::sqrt(clock / drawn) / s.errors.clock.sd_s, 1.0, 0.08);
  EXPECT_NEAR(std::sqrt(position / drawn / 3.0) / s.errors.position.sd_m, 1.0, 0.08);
}

Scenario table1(const std::string& stationing) {
  Scenario s = load_scenario(std::string(OLS_SCENARIOS) + "/table1.toml");
  choose_stationing(s.stationing, stationing);
  return s;
}

// What a station is told of the azimuth of its optical axis, north of it, minus the truth [rad].
double azimuth_error(const StationTruth& station) {
  const PanTilt angles = aim_along(station.truth, {0.0, radians(1.0)}).value();
  return wrap_pi(optical_axis(station.nominal, angles).azimuth_rad -
                 optical_axis(station.truth, angles).azimuth_rad);
}

struct HeadingErrors {
  double first_rad = 0.0, difference_rad = 0.0, stated_rad = 0.0;  // root mean squares, last stated
};

HeadingErrors heading_errors(const Scenario& s) {
  constexpr int kSeeds = 200;
  HeadingErrors e;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const World world(s, static_cast<std::uint64_t>(seed));
    const double west = azimuth_error(world.stations()[0]);
    e.first_rad += west * west / kSeeds;
    e.difference_rad += std::pow(west - azimuth_error(world.stations()[1]), 2) / kSeeds;
    e.stated_rad = world.stations()[0].nominal.sd.heading_rad;
  }
  e.first_rad = std::sqrt(e.first_rad), e.difference_rad = std::sqrt(e.difference_rad);
  return e;
}

TEST(World, LandmarksGiveHeadingsThatAreAsWrongAsStated) {
  const HeadingErrors e = heading_errors(table1("landmarks"));
  EXPECT_LT(degrees(e.stated_rad), 0.01);
  EXPECT_NEAR(e.first_rad / e.stated_rad, 1.0, 0.15);
  // The same landmarks turn both stations alike, and depth comes from the difference alone: that is
  // less than one error, not the root of two of them.
  EXPECT_LT(e.difference_rad, 0.8 * e.first_rad);
}

TEST(World, StationsThatSightEachOtherAreAsWrongAsTheirAimOverTheBase) {
  const HeadingErrors e = heading_errors(table1("each-other"));
  EXPECT_NEAR(e.stated_rad, std::hypot(0.05, 0.01, 0.01) / 30.0, 1e-5);
  EXPECT_NEAR(e.first_rad / e.stated_rad, 1.0, 0.15);
  EXPECT_GT(e.difference_rad, 1.2 * e.first_rad);
}

TEST(World, WithoutHeadingErrorsAStationingIsExactToTheEncodersStep) {
  Scenario s = table1("landmarks");
  switch_all_off(s.errors);
  EXPECT_LT(degrees(heading_errors(s).first_rad), 0.001);
}

TEST(World, RefusesALandmarkThatAStationCannotSee) {
  Scenario s = table1("landmarks");
  s.stationing.landmarks[1].p_ecef =
      LocalFrame(s.origin).to_ecef(s.stations[0].p_enu + Eigen::Vector3d(0, 0, 5000));
  EXPECT_THROW(World(s, 1), std::invalid_argument);
}

TEST(World, SameSeedSameWorld) {
  const World a(fig7(), 11), b(fig7(), 11), c(fig7(), 12);
  EXPECT_EQ(a.stations()[2].truth.chain.heading_rad, b.stations()[2].truth.chain.heading_rad);
  EXPECT_NE(a.stations()[2].truth.chain.heading_rad, c.stations()[2].truth.chain.heading_rad);
}

TEST(World, ASwitchedOffEncoderHasFinerSteps) {
  Scenario s = fig7();
  const PtuUnitConfig coarse = World(s, 1).ptu_unit_config();
  s.errors.encoder.on = false;
  const PtuUnitConfig fine = World(s, 1).ptu_unit_config();
  EXPECT_LT(fine.resolution_arcsec, coarse.resolution_arcsec / 10);
  EXPECT_NEAR(fine.pan_max_counts * fine.resolution_arcsec,
              coarse.pan_max_counts * coarse.resolution_arcsec, 10.0);
}

}  // namespace
}  // namespace ols::sim
