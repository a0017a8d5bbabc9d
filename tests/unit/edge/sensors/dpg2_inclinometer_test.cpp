// The inclinometer's thread on a real pty with a simulated sensor behind it. Function only.
#include "edge/sensors/dpg2/dpg2_inclinometer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <memory>

#include "edge/serial/serial_port.h"
#include "geometry/angles.h"
#include "sim/sensors/inclinometer_line.h"
#include "tests/unit/eventually.h"
#include "tests/unit/temp_dir.h"

namespace ols::sensors {
namespace {

sim::InclinometerLineConfig sensor() {
  sim::InclinometerLineConfig c;
  c.tilt_x_rad = radians(0.43);
  c.tilt_y_rad = radians(-0.084);
  c.noise_sd_rad = radians(0.002);
  c.rate_hz = 20.0;
  return c;
}

Dpg2Config config(const std::string& device) {
  Dpg2Config c;
  c.device = device;
  c.stale_s = 1.0;
  c.stuck_s = 2.0;
  return c;
}

bool reports(const Inclinometer& inclinometer, device::DeviceState state, const std::string& text) {
  return eventually([&] {
    const device::DeviceReport r = inclinometer.report();
    return r.state == state && r.text.find(text) != std::string::npos;
  });
}

TEST(Inclinometer, GivesTheTiltAndTheVersion) {
  const sim::InclinometerLine line(sensor(), 1);
  Dpg2Inclinometer inclinometer(config(line.device()));
  std::vector<TiltReading> readings;
  ASSERT_TRUE(eventually([&] {
    for (const auto& r : inclinometer.take_readings()) readings.push_back(r);
    return readings.size() >= 20;
  }));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    EXPECT_NEAR(degrees(readings[i].tilt_x_rad), 0.43, 0.02);
    EXPECT_NEAR(degrees(readings[i].tilt_y_rad), -0.084, 0.02);
    EXPECT_GE(readings[i].time_s, readings[i == 0 ? 0 : i - 1].time_s);
  }
  EXPECT_TRUE(reports(inclinometer, device::DeviceState::kOk, "DPG2 V1.4, x +0.4"));
  const device::DeviceReport report = inclinometer.report();
  EXPECT_NEAR(report.readings.at("inclinometer_x_deg"), 0.43, 0.02);
  EXPECT_NEAR(report.readings.at("inclinometer_y_deg"), -0.084, 0.02);
  EXPECT_GE(report.counters.at("inclinometer_readings"), 20U);
  EXPECT_EQ(report.counters.at("inclinometer_garbled"), 0U);
  EXPECT_TRUE(report.alarms.empty());
}

TEST(Inclinometer, GarbledLinesAreCountedAndTheRestIsRead) {
  sim::InclinometerLine line(sensor(), 2);
  sim::InclinometerFaults faults;
  faults.garble_share = 0.3;
  line.set_faults(faults);
  Dpg2Inclinometer inclinometer(config(line.device()));
  EXPECT_TRUE(eventually([&] {
    const auto counters = inclinometer.report().counters;
    return counters.at("inclinometer_garbled") >= 3 && counters.at("inclinometer_readings") >= 20;
  }));
}

TEST(Inclinometer, SilenceAndAStuckSensorAreToldAndHeal) {
  sim::InclinometerLine line(sensor(), 3);
  Dpg2Inclinometer inclinometer(config(line.device()));
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kOk, "x +0.4"));
  sim::InclinometerFaults faults;
  faults.silent = true;
  line.set_faults(faults);
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kFault, "no reading for"));
  EXPECT_GE(inclinometer.report().errors, 1U);
  line.set_faults({});
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kOk, "x +0.4"));
  faults = {};
  faults.stuck = true;
  line.set_faults(faults);
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kFault, "stuck at"));
  line.set_faults({});
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kOk, "x +0.4"));
}

TEST(Inclinometer, ASensorThatWasStoppedIsStartedAgain) {
  sim::InclinometerLine line(sensor(), 4);
  {
    serial::SerialPort port(line.device(), 9600);
    port.write("s");
    port.drain(1.0);
  }
  Dpg2Inclinometer inclinometer(config(line.device()));
  EXPECT_TRUE(reports(inclinometer, device::DeviceState::kOk, "x +0.4"));
}

TEST(Inclinometer, ADeviceThatIsNotThereYetOrVanishesIsOpenedAgain) {
  const std::string link = temp_dir() + "ols_inclinometer_" + std::to_string(::getpid());
  Dpg2Inclinometer inclinometer(config(link));
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kAbsent, link + ": cannot be opened"));
  EXPECT_EQ(inclinometer.report().alarms.size(), 1U);
  auto line = std::make_unique<sim::InclinometerLine>(sensor(), 5, link);
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kOk, "x +0.4"));
  line.reset();
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kAbsent, link));
  line = std::make_unique<sim::InclinometerLine>(sensor(), 6, link);
  ASSERT_TRUE(reports(inclinometer, device::DeviceState::kOk, "x +0.4"));
  EXPECT_EQ(inclinometer.report().counters.at("inclinometer_reopened"), 1U);
}

TEST(Inclinometer, EvenParityIsAccepted) {
  const sim::InclinometerLine line(sensor(), 7);
  Dpg2Config even = config(line.device());
  even.even_parity = true;
  Dpg2Inclinometer inclinometer(even);
  EXPECT_TRUE(reports(inclinometer, device::DeviceState::kOk, "x +0.4"));
}

TEST(Inclinometer, WithoutADeviceThereIsNone) {
  Dpg2Inclinometer inclinometer(Dpg2Config{});
  EXPECT_EQ(inclinometer.report().state, device::DeviceState::kAbsent);
  EXPECT_EQ(inclinometer.report().text, "not configured");
  EXPECT_TRUE(inclinometer.report().alarms.empty());
}

}  // namespace
}  // namespace ols::sensors
