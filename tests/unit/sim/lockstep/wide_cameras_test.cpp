// Two wide cameras that stand still, 300 m apart.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "sim/lockstep/lead_times.h"
#include "sim/lockstep/report.h"

namespace ols::sim {
namespace {

Scenario wide() { return load_scenario(std::string(OLS_SCENARIOS) + "/wide.toml"); }

// Over the errors of 20 sites: root mean square, over that of the bound of one exposure each.
TEST(WideCameras, ErrorIsThatOfTheBound) {
  constexpr int kSeeds = 20;
  constexpr double kPixelSd_px = 0.3;
  Scenario s = wide();
  keep_target(s, "1");
  s.detector_on = false;
  double squares = 0.0, bounds = 0.0;
  Eigen::Vector3d nees = Eigen::Vector3d::Zero();
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const World world(s, static_cast<std::uint64_t>(seed));
    Lockstep site(world, {.pictures = false, .pixel_sd_px = kPixelSd_px});
    site.run(20.0);
    const auto fixes = site.result().joint;
    ASSERT_GT(fixes.size(), 100U) << seed;
    const EstimatorSummary found = summarise(fixes);
    squares += std::pow(found.rmse_m, 2);
    nees += found.nees_axis / kSeeds;
    bounds += std::pow(summarise_bound(world, fixes, {.pixel_sd_px = kPixelSd_px}).crb_rmse_m, 2);
  }
  const double over = std::sqrt(squares / bounds);
  RecordProperty("rmse_m", std::to_string(std::sqrt(squares / kSeeds)));
  RecordProperty("error_over_bound", std::to_string(over));
  EXPECT_LT(over, 1.2);
  for (const double axis : nees) {
    EXPECT_GT(axis, 0.4);
    EXPECT_LT(axis, 2.0);
  }
}

std::size_t nearest(const World& world, const Fix& fix) {
  std::size_t best = 0;
  double least_m = 1e9;
  const Eigen::Vector3d there = ecef_from_geodetic(fix.position);
  for (std::size_t i = 0; i < world.scenario().targets.size(); ++i) {
    const double off_m = (there - world.target(i, fix.time_s).p_ecef).norm();
    if (off_m < least_m) best = i, least_m = off_m;
  }
  return best;
}

// Nobody designates: each object gets one target, which stays with it.
TEST(WideCameras, FiveObjectsAtOnceWithoutAnExchange) {
  const World world(wide(), 1);
  Lockstep site(world, nobody_designates(world.scenario()));
  site.run(25.0);
  std::map<std::int64_t, std::set<std::size_t>> objects_of;
  std::map<std::size_t, std::set<std::int64_t>> targets_of;
  std::map<std::size_t, double> last_s;
  for (const Fix& fix : site.result().joint) {
    if (fix.time_s < 10.0) continue;
    const std::size_t object = nearest(world, fix);
    objects_of[fix.target_id].insert(object);
    targets_of[object].insert(fix.target_id);
    last_s[object] = fix.time_s;
  }
  EXPECT_EQ(targets_of.size(), 5U);
  for (const auto& [id, objects] : objects_of) EXPECT_EQ(objects.size(), 1U) << "target " << id;
  for (const auto& [object, targets] : targets_of) {
    EXPECT_EQ(targets.size(), 1U) << "object " << object;
    EXPECT_GT(last_s[object], 24.0);
  }
}

}  // namespace
}  // namespace ols::sim
