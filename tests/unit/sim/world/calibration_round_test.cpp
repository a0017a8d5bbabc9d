#include "sim/world/calibration_round.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace ols::sim {
namespace {

World world() {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/new_units.toml");
  return {scenario, 5};
}

std::vector<nlohmann::json> observations_of(const CalibrationRound& round) {
  std::vector<nlohmann::json> observations;
  std::istringstream lines(round.observations);
  for (std::string line; std::getline(lines, line);) {
    observations.push_back(nlohmann::json::parse(line));
  }
  return observations;
}

TEST(CalibrationRound, HasFramesOfStarsAndLandmarksFromBothSides) {
  const CalibrationRound round = calibration_round(world(), 0);
  const auto observations = observations_of(round);
  const auto with = [&](const char* key, const nlohmann::json& value) {
    return std::ranges::count_if(observations, [&](const auto& one) { return one[key] == value; });
  };
  EXPECT_EQ(with("kind", "star"), 24 * 12);
  EXPECT_GE(with("kind", "landmark"), 8);
  for (const char* axis : {"approach_pan", "approach_tilt"}) {
    for (const int side : {1, -1}) EXPECT_GT(with(axis, side), 20) << axis << ' ' << side;
  }
  for (const auto& one : observations) {
    const std::string name = one["reference"];
    EXPECT_NE(round.references.find("\n" + name + ","), std::string::npos) << name;
  }
}

TEST(CalibrationRound, IsTheSameForTheSameSeedAndAnotherForEachStation) {
  EXPECT_EQ(calibration_round(world(), 1).observations, calibration_round(world(), 1).observations);
  EXPECT_NE(calibration_round(world(), 1).observations, calibration_round(world(), 2).observations);
}

}  // namespace
}  // namespace ols::sim
