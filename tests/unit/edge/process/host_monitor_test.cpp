#include "edge/process/host_monitor.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <optional>

#include "base/process/clocks.h"
#include "tests/unit/eventually.h"
#include "tests/unit/temp_dir.h"

namespace ols::station {
namespace {

TEST(HostMonitor, ReadsTheHottestZone) {
  const std::filesystem::path folder = temp_dir() + "host_watch_" + std::to_string(::getpid());
  for (const auto& [zone, text] : {std::pair("thermal_zone0", "41000\n"),
                                   {"thermal_zone1", "90500\n"},
                                   {"thermal_zone2", "nonsense\n"},
                                   {"cooling_device0", "99000\n"}}) {
    std::filesystem::create_directories(folder / zone);
    std::ofstream(folder / zone / "temp") << text;
  }
  HostConfig config;
  config.thermal_folder = folder;
  EXPECT_EQ(read_host(config).cpu_degC, 90.5);
  std::filesystem::remove_all(folder);
}

TEST(HostMonitor, AComputerWithoutThermometerAndDiskSaysNothing) {
  HostConfig config;
  config.thermal_folder = config.disk_folder = "/nonexistent";
  EXPECT_EQ(read_host(config).cpu_degC, std::nullopt);
  EXPECT_EQ(read_host(config).disk_free_bytes, std::nullopt);
  EXPECT_GT(read_host(HostConfig{}).disk_free_bytes.value_or(0.0), 0.0);
}

TEST(HostMonitor, HeatAndAnAlmostFullDiskAreAlarms) {
  HostMonitor watch({}, [] { return HostReading{90.5, 1e6}; });
  HostReport report;
  ASSERT_TRUE(eventually([&] {
    report = watch.look(clock_monotonic_s());
    return !report.alarms.empty();
  }));
  EXPECT_EQ(report.readings.at("cpu_degC"), 90.5);
  EXPECT_EQ(report.readings.at("disk_free_bytes"), 1e6);
  ASSERT_EQ(report.alarms.size(), 2U);
  EXPECT_EQ(report.alarms[0], "computer: processor at 90 C");
  EXPECT_EQ(report.alarms[1], "computer: 1 MB left on the disk");
}

TEST(HostMonitor, ADiskThatHangsHoldsNobodyAndIsAnAlarm) {
  const auto released = std::make_shared<std::promise<void>>();
  const auto let_go = released->get_future().share();
  const auto done = std::make_shared<std::promise<void>>();
  {
    HostMonitor watch({}, [let_go, done]() -> HostReading {
      let_go.wait();
      done->set_value();
      return {};
    });
    const double now_s = clock_monotonic_s();
    EXPECT_TRUE(watch.look(now_s).alarms.empty()) << "it may still come";
    const HostReport report = watch.look(now_s + 60.0);
    ASSERT_EQ(report.alarms.size(), 1U);
    EXPECT_NE(report.alarms[0].text.find("disk / does not answer for 6"), std::string::npos)
        << report.alarms[0].text;
    EXPECT_FALSE(report.readings.contains("disk_free_bytes"));
  }  // nor its end
  released->set_value();
  done->get_future().wait();
}

TEST(HostMonitor, CountsSlowTurnsAndShowsTheSlowest) {
  HostMonitor watch({}, [] { return HostReading{}; });
  watch.note_turn(0.01);
  watch.note_turn(0.7);
  watch.note_turn(0.02);
  EXPECT_EQ(watch.slow_turns(), 1U);
  EXPECT_EQ(watch.look(0.0).readings.at("slowest_turn_s"), 0.7);
  EXPECT_EQ(watch.look(0.0).readings.at("slowest_turn_s"), 0.0) << "since the last look";
}

TEST(HostMonitor, ShowsWhatOneTurnInAHundredTakesWithoutItsWait) {
  HostMonitor watch({}, [] { return HostReading{}; });
  for (int i = 0; i < 1000; ++i) watch.note_turn(0.3, 0.0);
  for (int i = 1; i <= 1000; ++i) watch.note_turn(1e-3 * (1001 - i) + 0.01, 0.01);
  EXPECT_NEAR(watch.look(0.0).readings.at("turn_p99_s"), 0.99, 0.0015) << "of the last thousand";
  EXPECT_EQ(watch.slow_turns(), 510U) << "with the wait";
}

}  // namespace
}  // namespace ols::station
