// The overview station in the whole site, in simulated time: a click in its picture brings the
// tracking stations onto the target, which none of them has ever seen.
#include "sim/lockstep/overview_click.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/lockstep/lockstep.h"

namespace ols::sim {
namespace {

Scenario overview() { return load_scenario(std::string(OLS_SCENARIOS) + "/overview.toml"); }

// As a person does: roughly there, zoomed in a little, then a click on what is in the picture.
void aim(const World& world, Lockstep& lockstep, double time_s) {
  const auto& stations = world.stations();
  const auto index = static_cast<std::size_t>(
      std::ranges::find(stations, "overview", &StationTruth::id) - stations.begin());
  const auto angles = aim_at(stations[index].nominal, world.target(0, time_s + 1.0).p_ecef);
  ASSERT_TRUE(angles);
  station::Station& station = lockstep.station("overview").station();
  ASSERT_EQ(station.point({*angles}, monotonic_s(time_s)), station::Refusal::kNone);
  station::LensCommand lens;
  lens.values.zoom = 0.3;
  ASSERT_EQ(station.lens(lens, monotonic_s(time_s)), station::Refusal::kNone);
}

// By function: docs/overview.md has how long it takes.
TEST(OverviewClick, EveryTrackingStationFollowsTheTarget) {
  const LeadTimes times = click_in_overview(overview(), 4, ClickConfig{.elapsed_s = 33.0});
  EXPECT_EQ(times.stations, 4U);
  EXPECT_TRUE(times.complete()) << times.follows.size() << " follow it";
  EXPECT_TRUE(times.located);
}

TEST(OverviewClick, NeedsAnOverviewStation) {
  EXPECT_THROW(click_in_overview(load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml"), 1, {}),
               std::runtime_error);
}

// The overview's picture is drawn at the zoom that its lens really has.
TEST(Overview, ItsPictureIsThatOfItsZoom) {
  const World world(overview(), 3);
  Fidelity fidelity = nobody_designates(world.scenario());
  fidelity.pictures = false;
  Lockstep lockstep(world, fidelity);
  lockstep.run(2.0);
  aim(world, lockstep, 2.0);
  lockstep.run(4.5);
  const cv::Rect2d box = lockstep.station("overview").view().box;
  station::LensCommand lens;
  lens.values.zoom = 0.5;
  lockstep.station("overview").station().lens(lens, monotonic_s(4.5));
  lockstep.run(6.0);
  const auto snapshot = lockstep.station("overview").station().snapshot();
  EXPECT_NEAR(*snapshot.lens.zoom, 0.5, 1e-3);
  const double truth_px = world.stations().back().zoom->camera_at(0.5).fx_px;
  EXPECT_LT(std::abs(*snapshot.focal_length_px - truth_px), 4.0 * snapshot.focal_length_sd_px);
  EXPECT_GT(snapshot.focal_length_sd_px, 1e-4 * truth_px);
  EXPECT_GT(lockstep.station("overview").view().box.width, 1.2 * box.width);
}

}  // namespace
}  // namespace ols::sim
