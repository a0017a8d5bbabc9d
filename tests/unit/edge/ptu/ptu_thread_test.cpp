// The real-time thread on a real pty with a simulated unit behind it. Function only: deadlines are
// generous, and nothing is judged by how long it took.
#include "edge/ptu/ptu_thread.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <system_error>
#include <thread>

#include "base/clocks.h"
#include "edge/ptu/serial_port.h"
#include "geometry/angles.h"
#include "tools/sim/ptu_line.h"

namespace ols {
namespace {

using sim::PtuLine;

sim::PtuUnitConfig unit() {
  sim::PtuUnitConfig config;
  config.baud = 115200;
  config.home_at_power_up = false;
  return config;
}

PtuConfig config(const std::string& device) {
  PtuConfig ptu;
  ptu.device = device;
  ptu.baud = 115200;
  ptu.poll_interval_s = 0.02;
  return ptu;
}

// Looks again and again until it is so; false after 30 s.
bool eventually(const std::function<bool()>& condition) {
  const double deadline_s = clock_monotonic_s() + 30.0;
  while (!condition()) {
    if (clock_monotonic_s() > deadline_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

bool ready(const PtuThread& ptu) { return ptu.status().state == PtuState::kReady; }

ServoGoal fixed_goal(double pan_deg, double tilt_deg) {
  const double now_s = clock_monotonic_s();
  return {now_s, {radians(pan_deg), radians(tilt_deg)}, {}, now_s + 5.0};
}

// Keeps the goal fresh until the unit is within a few counts of it.
bool arrives(PtuThread& ptu, PtuLine& line, double pan_deg, double tilt_deg) {
  return eventually([&] {
    ptu.set_goal(fixed_goal(pan_deg, tilt_deg));
    const PanTilt at = line.angles_at(clock_monotonic_s());
    return std::abs(degrees(at.pan_rad) - pan_deg) < 0.01 &&
           std::abs(degrees(at.tilt_rad) - tilt_deg) < 0.01;
  });
}

// No motion over three looks, more than the time of a poll apart.
bool stands(PtuLine& line) {
  double last = line.angles_at(clock_monotonic_s()).pan_rad;
  double since_s = clock_monotonic_s();
  return eventually([&] {
    const double now = line.angles_at(clock_monotonic_s()).pan_rad;
    if (now != last) since_s = clock_monotonic_s();
    last = now;
    return clock_monotonic_s() - since_s > 0.3;
  });
}

std::string temporary_link(const char* name) {
  return (std::filesystem::temp_directory_path() /
          (std::string("ols-") + name + "-" + std::to_string(::getpid())))
      .string();
}

TEST(PtuThread, BringsTheUnitToAGoalAndReportsItsAngles) {
  PtuLine line(unit(), 1);
  PtuThread ptu(config(line.device()));
  ASSERT_TRUE(eventually([&] { return ready(ptu); })) << ptu.status().last_error;
  ASSERT_TRUE(arrives(ptu, line, 5.0, -3.0));
  ptu.take_samples();
  std::vector<AngleSample> samples;
  ASSERT_TRUE(eventually([&] {
    ptu.set_goal(fixed_goal(5.0, -3.0));
    samples = ptu.take_samples();
    return !samples.empty();
  }));
  EXPECT_NEAR(degrees(samples.back().angles.pan_rad), 5.0, 0.02);
  EXPECT_NEAR(degrees(samples.back().angles.tilt_rad), -3.0, 0.02);
  const PtuStatus status = ptu.status();
  EXPECT_TRUE(status.port_open);
  EXPECT_EQ(status.port_failures, 0u);
  EXPECT_NEAR(status.pan_resolution_rad, radians(11.5714 / 3600.0), 1e-12);
  EXPECT_FALSE(status.firmware.empty());
}

TEST(PtuThread, HaltsTheUnitWhenItEnds) {
  PtuLine line(unit(), 1);
  auto ptu = std::make_unique<PtuThread>(config(line.device()));
  ASSERT_TRUE(eventually([&] { return ready(*ptu); }));
  // On a long way; without the halt it would go on for a look-ahead at full speed, to about 50.
  ASSERT_TRUE(eventually([&] {
    ptu->set_goal(fixed_goal(100.0, 0.0));
    return line.angles_at(clock_monotonic_s()).pan_rad > radians(3.0);
  }));
  ptu.reset();
  ASSERT_TRUE(stands(line));
  EXPECT_LT(degrees(line.angles_at(clock_monotonic_s()).pan_rad), 30.0);
}

TEST(PtuThread, OneClientAfterAnotherOnTheSameLine) {
  PtuLine line(unit(), 1);
  for (int client = 0; client < 3; ++client) {
    PtuThread ptu(config(line.device()));
    ASSERT_TRUE(eventually([&] { return ready(ptu); })) << ptu.status().last_error;
  }
}

TEST(PtuThread, OpensThePortAgainWhenItVanished) {
  const std::string link = temporary_link("vanishing");
  auto line = std::make_unique<PtuLine>(unit(), 1, link);
  PtuThread ptu(config(link));
  ASSERT_TRUE(eventually([&] { return ready(ptu); }));
  line.reset();
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
  ASSERT_TRUE(eventually([&] { return ptu.status().port_failures >= 2; }));
  EXPECT_EQ(ptu.status().state, PtuState::kFault);
  EXPECT_FALSE(ptu.status().port_open);
  EXPECT_NE(ptu.status().last_error.find(link), std::string::npos);
  line = std::make_unique<PtuLine>(unit(), 2, link);
  EXPECT_TRUE(eventually([&] { return ready(ptu); }));
}

TEST(SerialPort, SaysWhatIsWrongWithADevice) {
  EXPECT_THROW(SerialPort("/nonexistent/tty", 9600), std::system_error);
  EXPECT_THROW(SerialPort("/dev/null", 9600), std::system_error);
  PtuLine line(unit(), 1);
  EXPECT_THROW(SerialPort(line.device(), 9601), std::system_error);
  const SerialPort first(line.device(), 9600);
  EXPECT_THROW(SerialPort(line.device(), 9600), std::system_error);  // in use
}

TEST(PtuLine, DoesNotReplaceWhatIsNotALink) {
  EXPECT_THROW(PtuLine(unit(), 1, "/dev/null"), std::system_error);
}

}  // namespace
}  // namespace ols
