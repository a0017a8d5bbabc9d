// A real unit is stood in for by a simulated one behind a line of its own; the product's own driver
// is the master.
#include "sim/ptu/tap.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>

#include "base/process/clocks.h"
#include "edge/ptu/driver.h"
#include "sim/ptu/line.h"
#include "sim/ptu/tap_watch.h"
#include "tests/unit/eventually.h"
#include "tests/unit/sim/ptu/master.h"
#include "tests/unit/sim/serial/line_master.h"
#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

constexpr double kStep_rad = 11.5714 / 3600.0 * kPi / 180.0;

std::string path(const std::string& name) {
  return temp_dir() + "ols_tap_" + name + std::to_string(::getpid());
}

bool exists(const std::string& link) {
  return std::filesystem::exists(std::filesystem::symlink_status(link));
}

// One question at a time: both replies have come when this is over.
void ask_angles(serial::SerialPort& port) {
  port.write("PP TP ");
  std::string heard;
  eventually([&] {
    heard += port.read(0.01);
    return std::ranges::count(heard, '\n') == 2;
  });
}

TEST(PtuTap, PassesBytesOnAndSeesWhereTheUnitPoints) {
  PtuLine unit(ready_unit(), 1, path("unit"));
  PtuTap tap({path("unit"), 9600, kStep_rad}, 2, path("station"));
  ASSERT_TRUE(eventually([&] { return exists(path("station")); }));
  serial::SerialPort port(path("station"), 9600);
  EXPECT_TRUE(answers(port, " PA20000 TA20000 PP500 TP300 A ", "*\r\n*\r\n*\r\n*\r\n*\r\n"));
  EXPECT_TRUE(answers(port, "PP TP ", "* 500\r\n* 300\r\n"));
  EXPECT_TRUE(answers(port, "PP TP ", "* 500\r\n* 300\r\n"));
  const PanTilt now = tap.angles_at(1e9);
  EXPECT_NEAR(now.pan_rad, 500 * kStep_rad, 1e-9);
  EXPECT_NEAR(now.tilt_rad, 300 * kStep_rad, 1e-9);
}

TEST(PtuTap, WaitsForTheReadingBehindAnInstant) {
  PtuLine unit(ready_unit(), 1, path("unit"));
  PtuTap tap({path("unit"), 9600, kStep_rad}, 2, path("station"));
  tap.await(clock_monotonic_s());  // of a unit that has said nothing it expects nothing
  ASSERT_TRUE(eventually([&] { return exists(path("station")); }));
  serial::SerialPort port(path("station"), 9600);
  // Half a minute of motion, so that an angle that was guessed is another one later. The answer to
  // PX cannot be mistaken for the end of what the unit says at power-up.
  EXPECT_TRUE(answers(port, " PS1000 PA20000 PP30000 PX ", "* 49467\r\n"));
  std::jthread asking([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) ask_angles(port);
  });
  EXPECT_TRUE(eventually([&] { return tap.angles_at(clock_monotonic_s()).pan_rad > 0.01; }));
  int unchanged = 0;
  // It does not wait for ever: on a busy machine a reading may come too late for that.
  EXPECT_TRUE(eventually([&] {
    const double at_s = clock_monotonic_s();
    tap.await(at_s);
    const double known_rad = tap.angles_at(at_s).pan_rad;
    const auto readings = tap.counters().readings;
    EXPECT_TRUE(eventually([&] { return tap.counters().readings >= readings + 4; }));
    unchanged += std::abs(tap.angles_at(at_s).pan_rad - known_rad) < 1e-9 ? 1 : 0;
    return unchanged == 5;
  }));
}

TEST(PtuTap, FollowsTheStationToAnotherRate) {
  PtuLine unit(ready_unit(), 1, path("unit"));
  PtuTap tap({path("unit"), 9600, kStep_rad}, 2, path("station"));
  ASSERT_TRUE(eventually([&] { return exists(path("station")); }));
  {
    serial::SerialPort port(path("station"), 9600);
    EXPECT_TRUE(answers(port, " @(38400,0,F) ", "*\r\n"));
  }
  serial::SerialPort port(path("station"), 38400);
  EXPECT_TRUE(answers(port, " PX ", "* 49467\r\n"));
}

TEST(PtuTap, OutlivesTheUnitBeingUnplugged) {
  auto unit = std::make_unique<PtuLine>(ready_unit(), 1, path("unit"));
  PtuTap tap({path("unit"), 9600, kStep_rad}, 2, path("station"));
  ASSERT_TRUE(eventually([&] { return exists(path("station")); }));
  PtuFaults gone;
  gone.line_gone = true;
  unit->set_faults(gone);
  // The station's device goes with the unit's, and comes back with it.
  EXPECT_TRUE(eventually([&] { return !exists(path("station")); }));
  EXPECT_TRUE(eventually([&] { return tap.counters().failures > 1; }));
  unit->set_faults({});
  ASSERT_TRUE(eventually([&] { return exists(path("station")); }));
  serial::SerialPort port(path("station"), 9600);
  EXPECT_TRUE(answers(port, " PX ", "* 49467\r\n"));
}

TEST(PtuTap, HasTheFaultsOfALineOnly) {
  PtuLine unit(ready_unit(), 1, path("unit"));
  PtuTap tap({path("unit"), 9600, kStep_rad}, 2, path("station"));
  ASSERT_TRUE(eventually([&] { return exists(path("station")); }));
  PtuFaults faults;
  faults.line_gone = true;
  tap.set_faults(faults);
  EXPECT_TRUE(eventually([&] { return !exists(path("station")); }));
  EXPECT_TRUE(exists(path("unit")));
  faults.line_gone = false;
  faults.garble_share = 1.0;
  tap.set_faults(faults);
  ASSERT_TRUE(eventually([&] { return exists(path("station")); }));
  serial::SerialPort port(path("station"), 9600);
  port.write(" PX PX PX PX ");
  std::string heard;
  EXPECT_TRUE(eventually([&] {
    heard += port.read(0.01);
    return heard.size() > 24;
  }));
  EXPECT_EQ(heard.find("* 49467\r\n* 49467\r\n"), std::string::npos) << heard;
}

}  // namespace
}  // namespace ols::sim
