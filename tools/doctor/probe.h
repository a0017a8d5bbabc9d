// Looks at what the station would use: devices only where no station runs, and never moving one.
// Nothing throws: what goes wrong is in the answer.
#pragma once

#include "edge/config.h"
#include "edge/host_monitor.h"
#include "tools/doctor/facts.h"

namespace ols::doctor {

// Opens and closes the line, unless a program of ours has it: they lock it.
SerialFacts look_at_line(const std::string& device, int baud);

// Asks version, resolution, limits and supply, at the configured rates first and then at the
// others. A unit in its scan mode (which no program of ours uses) ends that at any byte.
PtuAnswers ask_ptu(const ptu::PtuConfig& config);

// All cameras that answer a broadcast.
struct CameraSeen {
  std::string id, address;  // the id as Aravis has it; no address: not on the network
};
std::vector<CameraSeen> cameras_that_answer();

// Opens the camera's control channel for a moment; no frame is taken.
CameraAnswers ask_camera(const camera::CameraConfig& config);

// The sensors by their own drivers, for as long as each takes to be well, at most `seconds`.
device::DeviceReport ask_gnss(const sensors::GnssConfig& config, double seconds);
device::DeviceReport ask_inclinometer(const sensors::InclinometerConfig& config, double seconds);
device::DeviceReport ask_lens(const lens::LensMotorConfig& config, double seconds);
// Reads the emergency stop; outputs stay untouched.
device::DeviceReport ask_gpio(const gpio::GpioConfig& config);

clock::ClockQuality ask_clock(const clock::ClockWatch::Config& config, double seconds);

LinkFacts look_at_link(const std::string& address);
FolderFacts look_at_folder(const std::string& name, const std::string& folder,
                           double reserve_bytes);
std::vector<UnitFacts> look_at_units(const std::vector<std::string>& units);

}  // namespace ols::doctor
