#include <gtest/gtest.h>

#include "central/offline/smoother.h"
#include "tests/unit/central/flight.h"

namespace ols::fusion {
namespace {

using namespace test;

constexpr double kNoise = 3e-4;

// Those with a position; counts the reasons of the other instants.
std::vector<Smoothed> smooth(const std::vector<BearingMeasurement>& bearings,
                             const std::vector<std::int64_t>& epochs,
                             const TrackManagerConfig& config, const KnownStations& known,
                             Unlocated& unlocated) {
  std::vector<Smoothed> fixes;
  const auto take = [&](Smoothed fix) {
    const Solution solution = fix.located.estimate.solution;
    if (solution != Solution::kOk) {
      ++unlocated[solution];
    } else {
      fixes.push_back(std::move(fix));
    }
  };
  fusion::smooth(pointers_to(bearings), epochs, config, known, {take});
  return fixes;
}

KnownStations nothing_known() { return {BiasModel(), {}}; }

std::vector<std::int64_t> every_tenth_of(double seconds) {
  std::vector<std::int64_t> epochs;
  for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i) {
    epochs.push_back(kStart + i * 100'000);
  }
  return epochs;
}

TEST(Smoother, JoinsWhatWasBeforeWithWhatComesAfter) {
  const auto bearings = flight(4.0, kNoise, kNoise);
  const auto epochs = every_tenth_of(3.9);
  Unlocated unlocated;
  const auto smoothed = smooth(bearings, epochs, {}, nothing_known(), unlocated);
  ASSERT_EQ(smoothed.size(), epochs.size());
  RecordedTrack causal{TrackManagerConfig{}};
  auto next = bearings.begin();
  double smoothed_m = 0.0, causal_m = 0.0;
  int surer = 0, fixes = 0;
  for (const Smoothed& fix : smoothed) {
    for (; next != bearings.end() && next->utime_us <= fix.utime_us; ++next) causal.add(*next);
    const double t_s = 1e-6 * static_cast<double>(fix.utime_us - kStart);
    const Eigen::Vector3d truth = site().to_ecef(path(t_s));
    ASSERT_EQ(fix.located.estimate.solution, Solution::kOk);
    if (causal.located() == nullptr || t_s > 3.0) continue;
    const KinematicState state = causal.located()->filter.at(fix.utime_us);
    smoothed_m += (fix.located.estimate.position_ecef - truth).norm();
    causal_m += (state.mean.head<3>() - truth).norm();
    surer += fix.located.estimate.covariance_ecef.trace() <
             state.covariance.topLeftCorner<3, 3>().trace();
    ++fixes;
  }
  ASSERT_GT(fixes, 20);
  EXPECT_LT(smoothed_m, causal_m);
  EXPECT_EQ(surer, fixes);
}

TEST(Smoother, CountsWhyThereIsNoPosition) {
  auto bearings = flight(1.0, kNoise, kNoise);
  std::erase_if(bearings, [](const BearingMeasurement& s) { return s.station != "a"; });
  Unlocated unlocated;
  EXPECT_TRUE(smooth(bearings, every_tenth_of(0.9), {}, nothing_known(), unlocated).empty());
  std::size_t sum = 0;
  for (const auto& [why, count] : unlocated) sum += count;
  EXPECT_EQ(sum, 9U);
  EXPECT_TRUE(smooth({}, {}, {}, nothing_known(), unlocated).empty());
}

}  // namespace
}  // namespace ols::fusion
