// The calibration that a station works with, and why not with the configured one: a station whose
// calibration cannot be used keeps working with its configuration's own values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edge/calibration_folder.h"
#include "edge/calibration_status.h"
#include "edge/device/device_report.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

class CalibrationInUse {
 public:
  // Reads the configured folder, if there is one. Never throws for what is in it.
  explicit CalibrationInUse(const StationSettings& configured);

  // What the station works with; the same object whatever is in use.
  const StationSettings& settings() const { return settings_; }
  // The devices say who they are only once they are open. True if the calibration is of others and
  // was dropped just now: settings() are others then.
  bool refuses(const std::vector<device::DeviceReport>& devices);
  // The same for what the unit says that a count is [rad]; zero: not known yet. A unit in another
  // step mode has other errors than were calibrated, and nobody has stated those but the
  // configuration. It stays so until a restart or another calibration.
  bool refuses(const PanTilt& count_rad);

  // Why these files are not of the devices that are open, nor of such counts; empty: they are, as
  // far as is known.
  static std::string conflict(const CalibrationFiles& files,
                              const std::vector<device::DeviceReport>& devices,
                              const PanTilt& count_rad);
  // Of each device that says another serial number than is configured; the serial numbers of an
  // instrument are the configured ones.
  static std::vector<std::string> other_devices(const InstrumentSerials& configured,
                                                const std::vector<device::DeviceReport>& devices);
  // From now on the station works with these: settings() are others.
  void adopt(const CalibrationFiles& files);

  CalibrationStatus status() const;
  // Why it is not used, and what to do; empty where there is nothing to say.
  std::vector<std::string> alarms() const;

 private:
  void read();
  void drop(const std::string& why);

  StationSettings configured_;
  StationSettings settings_;
  std::optional<CalibrationFiles> files_;
  std::string refused_;
};

}  // namespace ols::station
