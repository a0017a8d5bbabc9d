#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/lockstep/report.h"
#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

const Fidelity kPixels{false, 0.3};

Scenario scenario(const std::string& name) {
  return load_scenario(std::string(OLS_SCENARIOS) + "/" + name + ".toml");
}

LockstepResult run(const Scenario& s, std::uint64_t seed, double seconds,
                   const Fidelity& fidelity = kPixels) {
  const World world(s, seed);
  Lockstep lockstep(world, fidelity);
  lockstep.run(seconds);
  return lockstep.result();
}

double share(const StationRecord& record, bool (*of)(const FrameNote&)) {
  const auto count = std::count_if(record.frames.begin(), record.frames.end(), of);
  return static_cast<double>(count) / static_cast<double>(record.frames.size());
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Everything that one run writes.
std::string written(const Scenario& s, std::uint64_t seed, const Fidelity& fidelity,
                    double seconds) {
  const auto folder =
      std::filesystem::path(temp_dir()) / ("lockstep_" + std::to_string(::getpid()));
  const World world(s, seed);
  Lockstep lockstep(world, fidelity);
  lockstep.run(seconds);
  write_report(world, lockstep.result(), seconds, folder);
  std::string all;
  for (const char* name :
       {"truth.csv", "fixes.csv", "fixes_paper.csv", "frames.csv", "summary.json"}) {
    all += contents(folder / name);
  }
  std::filesystem::remove_all(folder);
  return all;
}

TEST(Lockstep, EveryStationIsDesignatedAndTracks) {
  const LockstepResult result = run(scenario("fig7"), 1, 20.0);
  EXPECT_GT(result.designated_s, 0.0);
  EXPECT_GT(result.joint.size(), 200U);
  for (const StationRecord& station : result.stations) {
    EXPECT_GT(share(station,
                    [](const FrameNote& n) { return n.state == station::StationState::kTracking; }),
              0.95);
    EXPECT_GT(share(station, [](const FrameNote& n) { return n.inside_third; }), 0.95);
  }
}

// The way back of stations that were restarted.
TEST(LockstepLeftAlone, StationsThatNobodyDesignatedComeToTrackBySlew) {
  constexpr double kBySlew_s = 8.0, kAgree_px = 3.0;
  const std::vector<std::string> alone{"alfa", "delta"};
  const Scenario s = scenario("fig7");
  const LockstepResult result = run(s, 1, 14.0, {true, 0.0, alone});
  ASSERT_FALSE(result.joint.empty());
  for (std::size_t i = 0; i < s.stations.size(); ++i) {
    if (std::ranges::find(alone, s.stations[i].id) == alone.end()) continue;
    SCOPED_TRACE(s.stations[i].id);
    std::vector<FrameNote> tracked = result.stations[i].frames;
    std::erase_if(tracked, [](const FrameNote& note) { return !note.error_px; });
    ASSERT_GT(tracked.size(), 30U);
    EXPECT_LT(tracked.front().mid_s - result.joint.front().time_s, kBySlew_s);
    for (const FrameNote& note : tracked) {
      EXPECT_LT(note.error_px->norm(), kAgree_px) << "at " << note.mid_s << " s";
    }
  }
}

TEST(Lockstep, WithoutErrorsThePositionIsExact) {
  Scenario s = scenario("fig7");
  Errors& e = s.errors;
  e.heading.on = e.tilt.on = e.mounting.on = e.position.on = e.distortion.on = false;
  e.clock.on = e.ptu_reply.on = e.messages.on = e.frames.on = e.encoder.on = false;
  const EstimatorSummary summary = summarise(run(s, 1, 20.0, {false, 0.01}).joint);
  // What is left: the designation, 1 px of 75 microradians at 350 m.
  EXPECT_LT(summary.rmse_m, 0.05);
  EXPECT_GT(summary.fixes, 200);
}

TEST(Lockstep, PublishedCovarianceIsHonestOverManySeeds) {
  // Wide limits: 24 seeds. tools/montecarlo measures it with hundreds.
  constexpr int kSeeds = 24;
  Eigen::Vector3d nees = Eigen::Vector3d::Zero();
  for (int seed = 1; seed <= kSeeds; ++seed) {
    nees += summarise(run(scenario("fig7"), seed, 20.0).joint).nees_axis / kSeeds;
  }
  for (const double axis : nees) {
    EXPECT_GT(axis, 0.4);
    EXPECT_LT(axis, 2.0);
  }
}

TEST(Lockstep, ServoKeepsAFastTargetInTheCentralThird) {
  const LockstepResult result = run(scenario("servo"), 1, 45.0);
  for (const StationRecord& station : result.stations) {
    EXPECT_GT(station.frames.size(), 500U);
    EXPECT_GE(share(station, [](const FrameNote& n) { return n.inside_third; }), 0.95);
  }
}

TEST(Lockstep, AllFramesLostMeansNoFix) {
  Scenario s = scenario("fig7");
  s.errors.frames.lost = 1.0;
  const LockstepResult result = run(s, 1, 6.0);
  EXPECT_LT(result.designated_s, 0.0);
  EXPECT_TRUE(result.joint.empty());
}

TEST(Lockstep, AllMessagesLostMeansNoFix) {
  Scenario s = scenario("fig7");
  s.errors.messages.lost = 1.0;
  const LockstepResult result = run(s, 1, 6.0);
  EXPECT_GT(result.designated_s, 0.0);
  EXPECT_TRUE(result.joint.empty());
}

TEST(Lockstep, SameSeedSameBytesWithoutPictures) {
  const Scenario s = scenario("fig7");
  const std::string first = written(s, 3, kPixels, 10.0);
  EXPECT_GT(first.size(), 10000U);
  EXPECT_EQ(first, written(s, 3, kPixels, 10.0));
  EXPECT_NE(first, written(s, 4, kPixels, 10.0));
}

TEST(Lockstep, SameSeedSameBytesWithPictures) {
  Scenario s = scenario("fig7");
  const Fidelity pictures{true, 0.0};
  const std::string first = written(s, 3, pictures, 4.0);
  EXPECT_EQ(first, written(s, 3, pictures, 4.0));
}

}  // namespace
}  // namespace ols::sim
