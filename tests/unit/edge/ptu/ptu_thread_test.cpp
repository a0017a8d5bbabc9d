// The real-time thread on a real pty with a simulated unit behind it. Function only: deadlines are
// generous, and nothing is judged by how long it took.
#include "edge/ptu/ptu_thread.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "base/process/clocks.h"
#include "geometry/angles.h"
#include "sim/ptu/line.h"
#include "tests/unit/eventually.h"

namespace ols::ptu {
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

bool ready(const PtuThread& ptu) { return ptu.status().state == PtuState::kReady; }

mount::Goal fixed_goal(double pan_deg, double tilt_deg) {
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
  std::vector<mount::AngleSample> samples;
  ASSERT_TRUE(eventually([&] {
    ptu.set_goal(fixed_goal(5.0, -3.0));
    samples = ptu.take_samples();
    return !samples.empty();
  }));
  EXPECT_NEAR(degrees(samples.back().angles.pan_rad), 5.0, 0.02);
  EXPECT_NEAR(degrees(samples.back().angles.tilt_rad), -3.0, 0.02);
  const PtuStatus status = ptu.status();
  EXPECT_TRUE(status.port.open);
  EXPECT_EQ(status.port.failures, 0u);
  EXPECT_FALSE(status.firmware.empty());
}

TEST(PtuThread, HaltsTheUnitWhenItEnds) {
  PtuLine line(unit(), 1);
  auto ptu = std::make_unique<PtuThread>(config(line.device()));
  ASSERT_TRUE(eventually([&] { return ready(*ptu); }));
  // On a long way; without the halt it would go on for a look-ahead at full speed, some 45 degrees.
  ASSERT_TRUE(eventually([&] {
    ptu->set_goal(fixed_goal(100.0, 0.0));
    return line.angles_at(clock_monotonic_s()).pan_rad > radians(3.0);
  }));
  ptu.reset();
  const double halted_rad = line.angles_at(clock_monotonic_s()).pan_rad;
  ASSERT_TRUE(stands(line));
  EXPECT_LT(degrees(line.angles_at(clock_monotonic_s()).pan_rad - halted_rad), 25.0);
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
  ASSERT_TRUE(eventually([&] { return ptu.status().port.failures >= 2; }));
  EXPECT_EQ(ptu.status().state, PtuState::kFault);
  EXPECT_FALSE(ptu.status().port.open);
  EXPECT_NE(ptu.status().last_error.find(link), std::string::npos);
  // It is another unit, as after a power cycle: the thread has not seen it home.
  line = std::make_unique<PtuLine>(unit(), 2, link);
  EXPECT_TRUE(eventually([&] { return ptu.reference() == mount::Reference::kDoubted; }));
  EXPECT_EQ(ptu.status().doubt, PtuDoubtCause::kPowerCycle);
  ptu.take_samples();
  ptu.reference_ok();
  EXPECT_TRUE(eventually([&] { return ready(ptu); }));
  EXPECT_TRUE(eventually([&] { return !ptu.take_samples().empty(); }));
}

TEST(PtuThread, HomesOnCommand) {
  PtuLine line(unit(), 1);
  PtuThread ptu(config(line.device()));
  ASSERT_TRUE(eventually([&] { return ready(ptu); }));
  ptu.home();
  EXPECT_TRUE(ptu.status().homing);
  // A reply that a busy machine gives too late is a fault, which abandons a homing: ordered again.
  EXPECT_TRUE(eventually([&] {
    if (!ptu.status().homing) ptu.home();
    return ptu.status().counters.homings >= 1;
  }));
  EXPECT_TRUE(eventually(
      [&] { return std::abs(line.angles_at(clock_monotonic_s()).tilt_rad) > radians(1.0); }));
}

TEST(PtuThread, HaltsAtOnceInAnEmergencyUntilItIsCleared) {
  PtuLine line(unit(), 1);
  PtuThread ptu(config(line.device()));
  ASSERT_TRUE(eventually([&] { return ready(ptu); }));
  ASSERT_TRUE(eventually([&] {
    ptu.set_goal(fixed_goal(150.0, 0.0));
    return line.angles_at(clock_monotonic_s()).pan_rad > radians(3.0);
  }));
  ptu.emergency_halt();
  EXPECT_TRUE(ptu.status().emergency);
  ASSERT_TRUE(stands(line));
  ASSERT_TRUE(eventually([&] { return ptu.status().standing; }));
  EXPECT_THAT(ptu.report().alarms, testing::Contains("ptu: emergency stop"));
  const double at_rad = line.angles_at(clock_monotonic_s()).pan_rad;
  EXPECT_LT(degrees(at_rad), 100.0);
  const std::uint64_t polls = ptu.status().counters.requests;
  ASSERT_TRUE(eventually([&] {
    ptu.set_goal(fixed_goal(150.0, 0.0));
    return ptu.status().counters.requests > polls + 20;
  }));
  EXPECT_EQ(line.angles_at(clock_monotonic_s()).pan_rad, at_rad);
  ptu.clear_emergency();
  EXPECT_FALSE(ptu.status().emergency);
  EXPECT_TRUE(eventually([&] {
    ptu.set_goal(fixed_goal(150.0, 0.0));
    return line.angles_at(clock_monotonic_s()).pan_rad > at_rad + radians(1.0);
  }));
}

// A line whose other end takes nothing: what waits in the queue is thrown away for the halt.
TEST(PtuThread, TheHaltGoesAheadOfWhatWaitsInTheQueue) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_GE(master, 0);
  ASSERT_EQ(::grantpt(master), 0);
  ASSERT_EQ(::unlockpt(master), 0);
  std::array<char, 128> name{};
  ASSERT_EQ(::ptsname_r(master, name.data(), name.size()), 0);
  PtuConfig slow = config(name.data());
  slow.baud = slow.line_baud = 9600;
  {
    PtuThread ptu(slow);
    pollfd entry{master, POLLIN, 0};
    ASSERT_TRUE(eventually([&] { return ::poll(&entry, 1, 0) > 0; }));  // " ED " or its like waits
    const double called_s = clock_monotonic_s();
    ptu.emergency_halt();
    std::string wire;
    // The halt may be before or behind a request that came between the look and the call.
    ASSERT_TRUE(eventually([&] {
      if (::poll(&entry, 1, 0) <= 0 || !ptu.status().counters.emergencies) return false;
      std::array<char, 256> buffer;
      const ssize_t n = ::read(master, buffer.data(), buffer.size());
      wire.append(buffer.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
      return wire.find(" H ") != std::string::npos;
    }));
    std::printf("H on the wire %.1f ms after the call\n", 1e3 * (clock_monotonic_s() - called_s));
    EXPECT_EQ(wire.substr(0, wire.find(" H ")).find("ED"), std::string::npos) << wire;
  }
  ::close(master);
}

TEST(PtuThread, OpensThePortAgainWhenTheUnitFallsSilent) {
  PtuLine line(unit(), 1);
  PtuThread ptu(config(line.device()));
  ASSERT_TRUE(eventually([&] { return ready(ptu); }));
  EXPECT_THAT(ptu.report().text, testing::HasSubstr("115200 baud"));
  sim::PtuFaults faults;
  faults.line_cut = true;
  line.set_faults(faults);
  ASSERT_TRUE(eventually([&] { return ptu.status().port.reopens > 0; }));
  EXPECT_TRUE(eventually([&] {
    const device::DeviceReport report = ptu.report();
    return report.state == device::DeviceState::kFault && !report.alarms.empty() &&
           report.counters.at("ptu_reopens") > 0;
  }));
  line.set_faults({});
  EXPECT_TRUE(eventually([&] { return ready(ptu); }));
}

TEST(PtuLine, DoesNotReplaceWhatIsNotALink) {
  EXPECT_THROW(PtuLine(unit(), 1, "/dev/null"), std::system_error);
}

}  // namespace
}  // namespace ols::ptu
