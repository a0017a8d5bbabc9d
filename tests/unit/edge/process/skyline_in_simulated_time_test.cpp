// What a station makes of the skyline of the land: its whole process in simulated time, with the
// thread that reads the land and compares the pictures. The station watches its horizon.
#include "geometry/angles.h"
#include "land/terrain_folder.h"
#include "sim/world/land_model.h"
#include "tests/unit/edge/process/station_in_simulated_time.h"

namespace ols::station {
namespace {

using test::Command;
constexpr const char* kDisagrees = "heading: disagrees with the skyline of the land by";
constexpr double kWrong_rad = radians(0.1);
constexpr double kRound_s = 150.0;  // more than a round of the watch takes

sim::Scenario among_hills() {
  sim::Scenario s = sim::load_scenario(std::string(OLS_SCENARIOS) + "/calibration.toml");
  s.frame_rate_hz = 1.0;
  s.inclinometer.on = s.gnss.on = false;
  s.unit_errors.size = sim::UnitErrors::kNone;
  s.camera.fx_px = s.camera.fy_px = 1500.0;
  s.errors.heading.sd_rad = s.errors.tilt.sd_rad = radians(0.01);
  s.landscape.ridge_mean_rad = radians(-40.0);
  s.landscape.ridge_relief_rad = 0.0;
  s.marks.clear();
  s.relief.roughness_m = 0.0;
  for (int i = 0; i < 24; ++i) {
    const double azimuth_rad = radians(15.0 * i), distance_m = 1200.0 + 400.0 * (i * 7 % 4);
    s.relief.hills.push_back(
        {.centre_m = distance_m * Eigen::Vector2d(std::sin(azimuth_rad), std::cos(azimuth_rad)),
         .height_m = 60.0 + 20.0 * (i * 5 % 7),
         .width_m = {90.0 + 10.0 * (i % 5), 150.0}});
  }
  s.relief.model = {.reach_m = 3200.0, .spacing_m = 10.0, .sd_m = 0.3, .length_m = 600.0};
  return s;
}

// The folder of the land as a survey has it.
void write_land(const sim::Scenario& scenario, const std::string& path) {
  const sim::LandModel model = sim::survey(scenario.relief, LocalFrame(scenario.origin), 5);
  const land::HeightGrid& grid = model.grid;
  const land::GridFile form{"",
                            "",
                            degrees(grid.north_rad),
                            degrees(grid.west_rad),
                            degrees(grid.step_latitude_rad),
                            degrees(grid.step_longitude_rad),
                            grid.rows,
                            grid.columns,
                            grid.sd_m};
  land::write_terrain_folder(path,
                             {.latitude_deg = degrees(scenario.origin.latitude_rad),
                              .longitude_deg = degrees(scenario.origin.longitude_rad),
                              .radius_km = 3.0},
                             {{form, *model.heights_m}}, {});
}

class StationSkyline : public test::StationInSimulatedTime {
 protected:
  StationSkyline() : StationSkyline(0.0, true) {}
  StationSkyline(double wrong_rad, bool has_land)
      : StationInSimulatedTime(among_hills(), [=](StationSettings& settings) {
          settings.land_folder = settings.state_folder + "/land";
          if (has_land) write_land(among_hills(), settings.land_folder);
          const double heading_rad = settings.station.geometry.chain.heading_rad;
          settings.station.geometry.chain.heading_rad += wrong_rad;
          settings.station.watch.middle = {heading_rad, radians(2.0)};
          settings.station.watch.size_rad = {radians(290.0), radians(5.0)};
        }) {}

  // What it says of its heading.
  std::string said() const {
    std::string all;
    for (const std::string& alarm : status_.alarm) {
      if (alarm.starts_with("heading:")) all += alarm;
    }
    return all;
  }
  // By so much; the unit does not notice.
  void knock(double turn_deg) {
    sim::StationFaults faults;
    faults.ptu.lost_steps_deg = turn_deg;
    station_->set_faults(faults);
  }
};

class StationWithWrongHeading : public StationSkyline {
 protected:
  StationWithWrongHeading() : StationSkyline(kWrong_rad, true) {}
};

class StationWithoutReadableLand : public StationSkyline {
 protected:
  StationWithoutReadableLand() : StationSkyline(0.0, false) {}
};

TEST_F(StationWithWrongHeading, SaysSoUntilItsReferenceIsInDoubt) {
  EXPECT_TRUE(time_.pass(2.0 * kRound_s, [this] { return says(kDisagrees); })) << said();
  EXPECT_TRUE(says("by +0."));
  EXPECT_TRUE(give(Command::COMMAND_HOME));
  EXPECT_TRUE(time_.pass(5.0, [this] { return !says(kDisagrees); }));
}

TEST_F(StationSkyline, ARightHeadingIsNeverDisputedAndAKnockIsNoticed) {
  EXPECT_FALSE(time_.pass(6.0 * kRound_s, [this] { return !said().empty(); })) << said();
  knock(degrees(2.0 * kWrong_rad));
  EXPECT_TRUE(time_.pass(6.0 * kRound_s, [this] { return says(kDisagrees); })) << said();
}

TEST_F(StationWithoutReadableLand, SaysSoAndWorks) {
  EXPECT_TRUE(is_said("heading: not compared with the skyline of the land: "));
  EXPECT_TRUE(says("/land/land.json"));
  EXPECT_TRUE(give(Command::COMMAND_POINT, 0.2));
}

}  // namespace
}  // namespace ols::station
