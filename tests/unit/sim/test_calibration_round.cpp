#include <gtest/gtest.h>

#include <algorithm>

#include "sim/calibration_round.h"

namespace ols::sim {
namespace {

World world() {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/new_units.toml");
  return {scenario, 5};
}

long lines_with(const std::string& text, const std::string& word) {
  long count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

TEST(CalibrationRound, HasFramesOfStarsAndLandmarksFromBothSides) {
  const CalibrationRound round = calibration_round(world(), 0);
  EXPECT_EQ(lines_with(round.observations, "\"star\""), 24 * 12);
  EXPECT_GE(lines_with(round.observations, "\"landmark\""), 8);
  for (const char* side : {"\"approach_pan\": 1,", "\"approach_pan\": -1,", "\"approach_tilt\": 1,",
                           "\"approach_tilt\": -1,"}) {
    EXPECT_GT(lines_with(round.observations, side), 20) << side;
  }
  EXPECT_EQ(lines_with(round.references, "\nstar"), 24 * 12);
}

TEST(CalibrationRound, IsTheSameForTheSameSeedAndAnotherForEachStation) {
  EXPECT_EQ(calibration_round(world(), 1).observations, calibration_round(world(), 1).observations);
  EXPECT_NE(calibration_round(world(), 1).observations, calibration_round(world(), 2).observations);
}

}  // namespace
}  // namespace ols::sim
