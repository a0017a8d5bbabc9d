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
  // Reads the configured folder, if there is one. Never throws, whatever it contains.
  explicit CalibrationInUse(const StationSettings& configured);

  // The settings that the station works with; always the same object.
  const StationSettings& settings() const { return settings_; }
  // Serial numbers are known only once the devices are open. True if the calibration belongs to
  // other devices and was dropped just now: settings() have changed then.
  bool refuses(const std::vector<device::DeviceReport>& devices);
  // The same for the size of a count that the unit reports [rad]; zero: not known yet. A unit in
  // another step mode has other errors than the calibrated ones, of which only the configuration
  // says anything. This holds until a restart or another calibration.
  bool refuses(const PanTilt& count_rad);

  // Why these files do not belong to the open devices or to such counts; empty: nothing contradicts
  // that they do.
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
