// The state of one device, in the same form for all devices, for the status message and ols-doctor.
// Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"

namespace ols::device {

// The values are those of station_status_t.
enum class DeviceState {
  kAbsent,    // configured, but not found
  kStarting,  // found, not usable yet
  kOk,
  kFault,  // found, but faulty
};
const char* to_string(DeviceState state);

struct DeviceReport {
  std::string name;  // "camera", "ptu", "gnss", "inclinometer", "gpio", "recorder", "video"
  DeviceState state = DeviceState::kAbsent;
  std::string text;                   // what the device is, or what is wrong with it
  std::string serial;                 // as the device itself says; empty: it does not, or not yet
  std::optional<double> last_good_s;  // CLOCK_MONOTONIC of the last good datum

  std::string last_error;    // the last error as text; empty: none yet
  std::uint64_t errors = 0;  // so far; a new error may have the text of an old one

  std::vector<Alarm> alarms;               // conditions that hold now
  std::map<std::string, double> readings;  // may fall; the name ends with the unit: ptu_supply_V
  std::map<std::string, std::uint64_t> counters;  // only rise; the name begins with the device
};

}  // namespace ols::device
