// Probes the devices and services that a station would use. Call the probes of devices only while
// no station runs on this host; they never move a device. No function throws: errors are in the
// results.
#pragma once

#include "edge/camera/aravis/aravis_config.h"
#include "edge/config/config.h"
#include "edge/process/host_monitor.h"
#include "edge/ptu/ptu_config.h"
#include "tools/doctor/facts.h"

namespace ols::doctor {

// Opens and closes the line. Does not open it if one of our programs has locked it.
SerialFacts look_at_line(const std::string& device, int baud);

// Queries the unit's version, resolution, limits and supply voltage. Tries the configured baud
// rates first, then the others. The queries end a unit's scan mode, which none of our programs
// uses.
PtuAnswers ask_ptu(const ptu::PtuConfig& config);
// ask_mount(), ask_camera(): run the station's own driver of a mount or camera, of any kind, until
// it reports that the device is well, but at most for `seconds`.
device::DeviceReport ask_mount(const mount::MountKind& kind, double seconds);
device::DeviceReport ask_camera(const camera::CameraKind& kind, double seconds);

// A camera that answers a broadcast.
struct CameraSeen {
  // `id`: from Aravis; `address`: empty if the camera is not on the network.
  std::string id, address;
};
std::vector<CameraSeen> cameras_that_answer();

// Opens the camera's control channel for a moment. Takes no frame.
CameraAnswers ask_camera(const camera::AravisConfig& config);

// The next three: run the driver of a sensor or lens until it reports that the device is well, but
// at most for `seconds`.
device::DeviceReport ask_gnss(const sensors::GnssKind& kind, double seconds);
device::DeviceReport ask_inclinometer(const sensors::InclinometerKind& kind, double seconds);
device::DeviceReport ask_lens(const lens::LensMotorConfig& config, double seconds);
// Reads the emergency stop input. Does not change outputs.
device::DeviceReport ask_gpio(const gpio::GpioConfig& config);

clock::ClockQuality ask_clock(const clock::ClockWatch::Config& config, double seconds);

LinkFacts look_at_link(const std::string& address);
FolderFacts look_at_folder(const std::string& name, const std::string& folder,
                           double reserve_bytes);
std::vector<UnitFacts> look_at_units(const std::vector<std::string>& units);

}  // namespace ols::doctor
