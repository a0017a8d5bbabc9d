#include "edge/host_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace ols {
namespace {

TEST(HostWatch, ReadsTheHottestZone) {
  const std::filesystem::path folder =
      testing::TempDir() + "host_watch_" + std::to_string(::getpid());
  for (const auto& [zone, text] : {std::pair("thermal_zone0", "41000\n"),
                                   {"thermal_zone1", "90500\n"},
                                   {"thermal_zone2", "nonsense\n"},
                                   {"cooling_device0", "99000\n"}}) {
    std::filesystem::create_directories(folder / zone);
    std::ofstream(folder / zone / "temp") << text;
  }
  HostConfig config;
  config.thermal_folder = folder;
  const HostReport report = HostWatch(config).look();
  EXPECT_EQ(report.readings.at("cpu_degC"), 90.5);
  ASSERT_EQ(report.alarms.size(), 1U);
  EXPECT_NE(report.alarms[0].find("processor"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(HostWatch, AComputerWithoutThermometerAndDiskSaysNothing) {
  HostConfig config;
  config.thermal_folder = config.disk_folder = "/nonexistent";
  const HostReport report = HostWatch(config).look();
  EXPECT_FALSE(report.readings.contains("cpu_degC"));
  EXPECT_FALSE(report.readings.contains("disk_free_bytes"));
  EXPECT_TRUE(report.alarms.empty());
}

TEST(HostWatch, AnAlmostFullDiskIsAnAlarm) {
  HostConfig config;
  config.disk_alarm_bytes = 1e18;
  EXPECT_EQ(HostWatch(config).look().alarms.size(), 1U);
}

TEST(HostWatch, CountsSlowTurnsAndShowsTheSlowest) {
  HostWatch watch{HostConfig{}};
  watch.note_turn(0.01);
  watch.note_turn(0.7);
  watch.note_turn(0.02);
  EXPECT_EQ(watch.slow_turns(), 1U);
  EXPECT_EQ(watch.look().readings.at("slowest_turn_s"), 0.7);
  EXPECT_EQ(watch.look().readings.at("slowest_turn_s"), 0.0) << "since the last look";
}

}  // namespace
}  // namespace ols
