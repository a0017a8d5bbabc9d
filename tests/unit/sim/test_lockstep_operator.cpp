// One operator marks the wrong thing; the other three stations follow the target.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "sim/lockstep.h"

namespace ols::sim {
namespace {

struct Wrong {
  const char* what;
  std::uint64_t seed;
  Misdesignation designation;
};
std::ostream& operator<<(std::ostream& out, const Wrong& wrong) { return out << wrong.what; }

class WrongDesignation : public testing::TestWithParam<Wrong> {};

// The template is of something that is soon out of sight: the station is slewed onto the target,
// where its own one is not to be found.
TEST_P(WrongDesignation, TheStationAcquiresWhatItIsSlewedOnto) {
  constexpr double kAcquired_s = 9.0, kAgree_px = 3.0;  // measured: 5.8 to 6.8 s
  const Wrong& wrong = GetParam();
  const World world(load_scenario(std::string(OLS_SCENARIOS) + "/faults.toml"), wrong.seed);
  Fidelity fidelity;
  fidelity.misdesignated = {wrong.designation};
  Lockstep lockstep(world, fidelity);
  lockstep.run(14.0);
  const auto& stations = world.stations();
  const auto index = static_cast<std::size_t>(
      std::ranges::find(stations, wrong.designation.station, &StationTruth::id) - stations.begin());
  const auto frames = lockstep.result().stations[index].frames;
  ASSERT_FALSE(frames.empty()) << "it was never designated";
  const double began_s = frames.front().mid_s;
  const auto first = std::ranges::find_if(frames, [](const FrameNote& note) {
    return note.error_px && note.error_px->norm() < kAgree_px;
  });
  ASSERT_NE(first, frames.end()) << "never on the target";
  EXPECT_GT(first->mid_s - began_s, 1.0) << "it was designated rightly";
  EXPECT_LT(first->mid_s - began_s, kAcquired_s);
  EXPECT_EQ(frames.back().state, station::StationState::kTracking);
}

INSTANTIATE_TEST_SUITE_P(Lockstep, WrongDesignation,
                         testing::Values(Wrong{"sky", 1, {"bravo", 0, {120.0, -80.0}}},
                                         Wrong{"beside", 1, {"alfa", 0, {40.0, 0.0}}},
                                         Wrong{"clouds", 2, {"bravo", 0, {-150.0, -60.0}}}),
                         [](const auto& test) { return std::string(test.param.what); });

// A tracker that holds on to the background believes in it: the station follows that, and only the
// fusion can know that no other station follows it.
TEST(WrongDesignations, TheFusionNamesWhoFollowsTheBackground) {
  const World world(load_scenario(std::string(OLS_SCENARIOS) + "/faults.toml"), 1);
  Fidelity fidelity;
  fidelity.misdesignated = {{"alfa", 0, {-100.0, 60.0}}};
  Lockstep lockstep(world, fidelity);
  lockstep.run(16.0);
  const LockstepResult result = lockstep.result();
  EXPECT_EQ(result.stations[0].frames.back().state, station::StationState::kTracking);
  ASSERT_EQ(result.alarms.size(), 1U);
  EXPECT_TRUE(result.alarms[0].starts_with("station alfa: ")) << result.alarms[0];
}

}  // namespace
}  // namespace ols::sim
