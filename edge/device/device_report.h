// The state of a device, for the status message and ols-doctor. The form of the report is the same
// for all devices. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"

namespace ols::device {

// The numerical values are those in the message station_status_t.
enum class DeviceState {
  kAbsent,    // configured, but not found
  kStarting,  // found, not usable yet
  kOk,
  kFault,  // found, but not working properly
};
const char* to_string(DeviceState state);

struct DeviceReport {
  std::string name;  // "camera", "ptu", "gnss", "inclinometer", "gpio", "recorder", "video"
  DeviceState state = DeviceState::kAbsent;
  std::string text;    // the device's identity, or what is wrong with it
  std::string serial;  // serial number as the device states it; empty if it has stated none
  std::optional<double> last_good_s;  // CLOCK_MONOTONIC of the last good datum

  std::string last_error;    // the last error as text; empty if there was none
  std::uint64_t errors = 0;  // number of errors so far; two errors may have the same text

  std::vector<Alarm> alarms;  // the present alarms
  // Measured values by name; the name ends with the unit: ptu_supply_V.
  std::map<std::string, double> readings;
  // Counters by name, which only increase; the name begins with that of the device.
  std::map<std::string, std::uint64_t> counters;
};

}  // namespace ols::device
