// What a station makes of the skyline of the land: its whole process in simulated time, with the
// thread that reads the land and compares the pictures. The station watches its horizon.
#include <map>

#include "geometry/angles.h"
#include "land/seen_skyline.h"
#include "land/terrain_folder.h"
#include "ols_msg/skyline_t.hpp"
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
  StationSkyline(double wrong_rad, bool has_land, const sim::Scenario& scenario = among_hills())
      : StationInSimulatedTime(scenario, [=](StationSettings& settings) {
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

// Trees in the east, higher than the land behind them by this.
constexpr double kTreesDistance_m = 400.0, kAboveLand_rad = radians(1.2);
sim::Scenario behind_trees() {
  sim::Scenario s = among_hills();
  const sim::World world(s, 5);
  const Eigen::Vector3d camera_m = world.camera_enu(0);
  const Eigen::Vector2d east(1.0, 0.0);
  const double top_rad =
      std::atan(world.relief()->highest_slope(camera_m, east, 3000.0)) + kAboveLand_rad;
  for (int i = -4; i <= 4; ++i) {
    const Eigen::Vector2d place_m = camera_m.head<2>() + Eigen::Vector2d(kTreesDistance_m, 3.0 * i);
    const double top_m = camera_m.z() + kTreesDistance_m * std::tan(top_rad);
    s.relief.trees.push_back({place_m, top_m - world.relief()->ground_m(place_m), 2.0});
  }
  return s;
}

class StationBehindTrees : public StationSkyline {
 protected:
  StationBehindTrees() : StationSkyline(0.0, true, behind_trees()) {
    bus_.subscribe("OLS_SKYLINE_alfa", [this](const BusMessage& message) {
      ols_msg::skyline_t part{};
      ASSERT_TRUE(decode_of_schema(message, part));
      if (std::exchange(begun_us_, part.begun_utime) != part.begun_utime) crests_.clear();
      for (std::size_t i = 0; i < part.column.size(); ++i) {
        crests_[part.column[i]] = {part.elevation_rad[i], part.sd_rad[i], part.hides_from_m[i],
                                   part.disagrees[i] != 0};
      }
      sees_trees_ = are_seen(of_trees());
    });
  }
  // Of the columns well within the trees.
  std::vector<land::SeenCrest> of_trees() const {
    std::vector<land::SeenCrest> found;
    for (const auto& [column, crest] : crests_) {
      const double off_rad = land::SeenSkyline::azimuth_rad(column) - 0.5 * kPi;
      if (std::abs(off_rad) < 8.0 / kTreesDistance_m) found.push_back(crest);
    }
    return found;
  }
  static bool are_seen(const std::vector<land::SeenCrest>& crests) {
    return crests.size() > 15 && std::ranges::all_of(crests, &land::SeenCrest::disagrees);
  }

  std::int64_t begun_us_ = 0;
  std::map<int, land::SeenCrest> crests_;  // by column
  bool sees_trees_ = false;                // in the crests
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

TEST_F(StationBehindTrees, SaysWhatTheyHideAndKnowsItAfterARestart) {
  ASSERT_TRUE(time_.pass(4.0 * kRound_s, [this] { return sees_trees_; })) << of_trees().size();
  const double top_rad = std::atan(
      world_.relief()->highest_slope(world_.camera_enu(0), Eigen::Vector2d(1.0, 0.0), 3000.0));
  for (const land::SeenCrest& crest : of_trees()) {
    EXPECT_NEAR(crest.elevation_rad, top_rad, radians(0.1));
    EXPECT_GT(crest.hides_from_m, 100.0);
  }
  double others = 0.0, disagree = 0.0;
  for (const auto& [column, crest] : crests_) {
    const double off_rad = land::SeenSkyline::azimuth_rad(column) - 0.5 * kPi;
    if (std::abs(off_rad) < 20.0 / kTreesDistance_m) continue;
    others += 1.0;
    disagree += crest.disagrees ? 1.0 : 0.0;
  }
  EXPECT_GT(others, 1000.0);
  EXPECT_LT(disagree, 0.05 * others);
  time_.pass(SkylineStore::kInterval_s + 10.0, [] { return false; });
  const auto begun_us = begun_us_;
  restart();
  crests_.clear();
  sees_trees_ = false;
  begun_us_ = 0;
  EXPECT_TRUE(time_.pass(kRound_s, [this] { return sees_trees_; }));
  EXPECT_EQ(begun_us_, begun_us);
  EXPECT_TRUE(give(Command::COMMAND_HOME));
  EXPECT_TRUE(time_.pass(kRound_s, [&] { return begun_us_ != begun_us; }));
}

TEST_F(StationWithoutReadableLand, SaysSoAndWorks) {
  EXPECT_TRUE(is_said("heading: not compared with the skyline of the land: "));
  EXPECT_TRUE(says("/land/land.json"));
  EXPECT_TRUE(give(Command::COMMAND_POINT, 0.2));
}

}  // namespace
}  // namespace ols::station
