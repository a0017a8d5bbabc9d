// The host's clock may be stepped while the site runs: this program brings a clock_gettime of its
// own that does so.
#include "sim/live/live_site.h"

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <ctime>

#include "base/process/clocks.h"
#include "ols_msg/truth_ptu_t.hpp"
#include "ols_msg/truth_target_t.hpp"
#include "tests/unit/eventually.h"
#include "tests/unit/temp_dir.h"

namespace {
std::atomic<std::int64_t> utc_step_s{0};
}

extern "C" int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const long result = syscall(SYS_clock_gettime, clock, now);
  if (clock == CLOCK_REALTIME) now->tv_sec += utc_step_s;
  return static_cast<int>(result);
}

namespace ols::sim {
namespace {

Scenario without_stations() {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
  scenario.stations.clear();
  return scenario;
}

ols_msg::truth_target_t published(LiveSite& site, LcmBus& bus, ols_msg::truth_target_t& received) {
  site.publish_truth();
  EXPECT_EQ(bus.handle(1000), 1);
  return received;
}

TEST(LiveSite, SteppedHostClockMovesNeitherTargetNorItsStamp) {
  const World world(without_stations(), 1);
  LcmBus bus("memq://");
  ols_msg::truth_target_t received{};
  bus.subscribe("OLS_SIM_TRUTH",
                [&](const BusMessage& message) { EXPECT_TRUE(decode_exactly(message, received)); });
  LiveSite site(world, temp_dir() + "ols_live_site_" + std::to_string(::getpid()), bus);

  const std::int64_t utc_us = clock_utime_us();
  const auto before = published(site, bus, received);
  EXPECT_NEAR(static_cast<double>(before.utime - utc_us), 0.0, 5e6);

  utc_step_s = 3600;
  EXPECT_GT(clock_utime_us() - utc_us, 3'599'000'000);  // the step is really seen
  const auto after = published(site, bus, received);
  utc_step_s = 0;

  const double later_s = 1e-6 * static_cast<double>(after.utime - before.utime);
  EXPECT_GE(later_s, 0.0);
  EXPECT_LT(later_s, 5.0);
  const Eigen::Vector3d moved =
      Eigen::Vector3d(after.position_ecef_m) - Eigen::Vector3d(before.position_ecef_m);
  const Eigen::Vector3d expected = later_s * Eigen::Vector3d(before.velocity_ecef_m_s);
  EXPECT_LT((moved - expected).norm(), 0.5 + 10.0 * later_s * later_s);
}

Scenario with_an_external_mount() {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/rtsp.toml");
  scenario.stations.resize(1);
  StationScenario& station = scenario.stations.front();
  station.fixed.reset();
  station.rtsp = false;
  station.camera_address = "127.0.0.71";  // of no other test: they run side by side
  station.mount = MountModel::kExternal;
  return scenario;
}

TEST(LiveSite, AnExternalMountHasTheAnglesThatItsProgramPublishes) {
  const World world(with_an_external_mount(), 1);
  LcmBus bus("memq://");
  ols_msg::truth_ptu_t received{};
  bus.subscribe("OLS_SIM_PTU_alfa",
                [&](const BusMessage& message) { EXPECT_TRUE(decode_exactly(message, received)); });
  LiveSite site(world, temp_dir() + "ols_live_site_" + std::to_string(::getpid()), bus);
  ols_msg::truth_ptu_t stated{};
  stated.utime = clock_utime_us() - 500'000;
  stated.interval_s = 0.25;
  stated.samples = 2;
  stated.pan_rad = {0.1, 0.3};
  stated.tilt_rad = {-0.2, -0.1};
  bus.publish("OLS_SIM_ANGLES_alfa", stated);
  bus.handle(1000);
  // The first truth has no sample: none is due yet.
  ASSERT_TRUE(eventually([&] {
    site.publish_truth();
    bus.handle(10);
    return !received.pan_rad.empty();
  }));
  EXPECT_EQ(received.pan_rad.back(), 0.3);
  EXPECT_EQ(received.tilt_rad.back(), -0.1);
}

}  // namespace
}  // namespace ols::sim
