// Probes what the station would use. Probes devices only where no station runs, and never moves
// one. No function throws: errors are in the answer.
#pragma once

#include "edge/camera/aravis/aravis_config.h"
#include "edge/config/config.h"
#include "edge/process/host_monitor.h"
#include "edge/ptu/ptu_config.h"
#include "tools/doctor/facts.h"

namespace ols::doctor {

// Opens and closes the line, unless one of our programs holds it: they lock it.
SerialFacts look_at_line(const std::string& device, int baud);

// Asks for version, resolution, limits and supply, first at the configured rates, then at the
// others. Any byte ends a unit's scan mode (which none of our programs uses).
PtuAnswers ask_ptu(const ptu::PtuConfig& config);
// Asks a mount or a camera of any kind, with the station's own code for it. Returns when the device
// is well, or after `seconds`.
device::DeviceReport ask_mount(const mount::MountKind& kind, double seconds);
device::DeviceReport ask_camera(const camera::CameraKind& kind, double seconds);

// All cameras that answer a broadcast.
struct CameraSeen {
  std::string id, address;  // the id from Aravis; no address: not on the network
};
std::vector<CameraSeen> cameras_that_answer();

// Opens the camera's control channel for a moment. Takes no frame.
CameraAnswers ask_camera(const camera::AravisConfig& config);

// Runs the sensors' own drivers until each is well, at most `seconds`.
device::DeviceReport ask_gnss(const sensors::GnssKind& kind, double seconds);
device::DeviceReport ask_inclinometer(const sensors::InclinometerKind& kind, double seconds);
device::DeviceReport ask_lens(const lens::LensMotorConfig& config, double seconds);
// Reads the emergency stop. Outputs are not touched.
device::DeviceReport ask_gpio(const gpio::GpioConfig& config);

clock::ClockQuality ask_clock(const clock::ClockWatch::Config& config, double seconds);

LinkFacts look_at_link(const std::string& address);
FolderFacts look_at_folder(const std::string& name, const std::string& folder,
                           double reserve_bytes);
std::vector<UnitFacts> look_at_units(const std::vector<std::string>& units);

}  // namespace ols::doctor
