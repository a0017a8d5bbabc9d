// The calibration that a station works with, or the reason why the configured one is not used.
// Without a usable calibration, a station works with the values in its own configuration.
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

  // The settings that the station uses; always a reference to the same object.
  const StationSettings& settings() const { return settings_; }
  // True if the calibration was dropped just now because it belongs to other devices; settings()
  // has changed. Serial numbers are known only once the devices are open.
  bool refuses(const std::vector<device::DeviceReport>& devices);
  // As above, for the size of a count [rad] that the unit reports; 0 if it is not known yet. A unit
  // in a different step mode has errors other than the calibrated ones. The calibration stays
  // dropped until a restart or another calibration.
  bool refuses(const PanTilt& count_rad);

  // Why these files cannot belong to the open devices, or to counts of this size; empty if they
  // can.
  static std::string conflict(const CalibrationFiles& files,
                              const std::vector<device::DeviceReport>& devices,
                              const PanTilt& count_rad);
  // One alarm for each device whose serial number differs from the configured one. This is needed
  // because a new instrument gets the configured serial numbers.
  static std::vector<Alarm> other_devices(const InstrumentSerials& configured,
                                          const std::vector<device::DeviceReport>& devices);
  // Uses these files from now on; settings() changes.
  void adopt(const CalibrationFiles& files);

  CalibrationStatus status() const;
  // Why the calibration is not used, and what to do; empty if there is nothing to report.
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
