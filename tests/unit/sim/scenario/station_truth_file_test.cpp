#include "sim/scenario/station_truth_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

TEST(StationTruthFile, HasTheTruthAndNotTheConfiguration) {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/new_units.toml");
  const World world(scenario, 3);
  const std::string folder = temp_dir() + "ols_truth_" + std::to_string(::getpid());
  write_station_truths(world, folder);
  for (const StationTruth& station : world.stations()) {
    std::ifstream file(folder + "/" + station.id + ".json");
    const auto truth = nlohmann::json::parse(file);
    EXPECT_EQ(truth.size(), 16u);
    EXPECT_NEAR(truth["heading_deg"], degrees(station.truth.chain.heading_rad), 1e-9);
    EXPECT_NE(truth["heading_deg"], degrees(station.nominal.chain.heading_rad));
    EXPECT_NEAR(truth["mount_x_deg"], degrees(station.truth.chain.mount_x_rad), 1e-9);
    EXPECT_NEAR(truth["trunnion_deg"], degrees(station.unit.trunnion_rad), 1e-9);
    EXPECT_NEAR(truth["focal_px"], station.truth.camera.fx_px, 1e-6);
    EXPECT_NEAR(truth["latitude_deg"], degrees(station.truth.position.latitude_rad), 1e-9);
  }
}

}  // namespace
}  // namespace ols::sim
