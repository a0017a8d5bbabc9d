// Keeps the calibration that a station uses, or the reason why the configured one is not used.
// Without a usable calibration, a station uses the values of its own configuration.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/calibration/calibration_folder.h"
#include "edge/calibration/calibration_status.h"
#include "edge/device/device_report.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

class ActiveCalibration {
 public:
  // Reads the configured folder, if there is one. Never throws, whatever the folder contains.
  explicit ActiveCalibration(const StationSettings& configured);

  // The settings that the station uses. The reference stays valid when the settings change.
  const StationSettings& settings() const { return settings_; }
  // Compares the serial numbers of the devices, which are known only once the devices are open.
  // Returns true if this call has dropped the calibration, because it belongs to other devices;
  // settings() has then changed.
  bool refuses(const std::vector<device::DeviceReport>& devices);
  // Likewise, compares the size of a count [rad] that the unit reports; 0 while it is unknown. In
  // another step mode, a unit has other errors than the calibrated ones. A dropped calibration is
  // not used again until a restart, or until another calibration is adopted.
  bool refuses(const PanTilt& count_rad);

  // Why these files cannot belong to these devices, or to counts of this size [rad]; empty if they
  // can.
  static std::string conflict(const CalibrationFiles& files,
                              const std::vector<device::DeviceReport>& devices,
                              const PanTilt& count_rad);
  // One alarm for each device whose serial number differs from the configured one. This matters
  // because a new instrument file takes over the configured serial numbers.
  static std::vector<Alarm> other_devices(const InstrumentSerials& configured,
                                          const std::vector<device::DeviceReport>& devices);
  // Uses these files from now on, and changes settings().
  void adopt(const CalibrationFiles& files);

  CalibrationStatus status() const;
  // The alarm that says why the calibration is not used; empty if there is nothing to report.
  std::vector<Alarm> alarms() const;

 private:
  void read();
  void drop(const std::string& why);

  StationSettings configured_;
  StationSettings settings_;
  std::optional<CalibrationFiles> files_;
  std::string refused_;
};

}  // namespace ols::station
