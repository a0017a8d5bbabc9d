// Looks at devices by the station's own code for them, for ols-doctor.
#include <chrono>
#include <system_error>
#include <thread>

#include "base/process/clocks.h"
#include "edge/clock/clock_pair.h"
#include "edge/clock/clock_source.h"
#include "edge/gpio/gpio_lines.h"
#include "edge/gpio/line_use.h"
#include "edge/lens/lens_motor.h"
#include "tools/doctor/probe.h"

namespace ols::doctor {
namespace {

constexpr auto kPoll = std::chrono::milliseconds(50);

template <typename Well>
void wait_until(Well well, double seconds) {
  const double end_s = clock_monotonic_s() + seconds;
  while (!well() && clock_monotonic_s() < end_s) std::this_thread::sleep_for(kPoll);
}

device::DeviceReport report_of(const auto& device, double seconds) {
  wait_until([&] { return device.report().state == device::DeviceState::kOk; }, seconds);
  return device.report();
}

}  // namespace

device::DeviceReport ask_camera(const camera::CameraKind& kind, double seconds) {
  return report_of(*kind.open(false), seconds);
}

device::DeviceReport ask_mount(const mount::MountKind& kind, double seconds) {
  return report_of(*kind.open(), seconds);
}

device::DeviceReport ask_gnss(const sensors::GnssKind& kind, double seconds) {
  return report_of(*kind.open(), seconds);
}

device::DeviceReport ask_inclinometer(const sensors::InclinometerKind& kind, double seconds) {
  return report_of(*kind.open(), seconds);
}

device::DeviceReport ask_lens(const lens::LensMotorConfig& config, double seconds) {
  return report_of(lens::LensMotor(config), seconds);
}

device::DeviceReport ask_gpio(const gpio::GpioConfig& config) {
  constexpr double kLevel_s = 0.5;
  device::DeviceReport report;
  report.name = "gpio";
  try {
    gpio::LineUse use;
    if (config.has_stop()) use.inputs.push_back(gpio::stop_input_line(config));
    const auto lines = gpio::open_gpio_lines(config.chip, use);
    report.state = device::DeviceState::kOk;
    report.text = config.chip;
    if (!config.has_stop()) return report;
    std::vector<gpio::LineLevel> levels;
    lines->refresh();
    wait_until([&] { return !(levels = lines->receive()).empty(); }, kLevel_s);
    if (levels.empty()) {
      report.state = device::DeviceState::kFault;
      report.text += ": the emergency stop's line does not answer";
    } else {
      report.text +=
          levels.back().high ? ", emergency stop's line is high" : ", emergency stop's line is low";
    }
  } catch (const std::system_error& trouble) {
    report.state = device::DeviceState::kAbsent;
    report.text = trouble.what();
  }
  return report;
}

clock::ClockQuality ask_clock(const clock::ClockWatch::Config& config, double seconds) {
  clock::ClockWatch watch(config);
  clock::ClockSource source;
  const clock::ClockPair now = clock::read_clock_pair();
  watch.tick(now.monotonic_s, now.utime_us);
  std::optional<clock::ClockReading> reading;
  wait_until([&] { return (reading = source.take()).has_value(); }, seconds);
  if (reading) watch.add(*reading);
  return watch.quality(clock_monotonic_s());
}

}  // namespace ols::doctor
