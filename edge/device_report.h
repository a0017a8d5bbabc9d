// How one device of a station is, in the same words for every kind of device. What the status
// message and ols-doctor show. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ols::station {

enum class DeviceState {
  kAbsent,    // configured, but not there
  kStarting,  // there, not of use yet
  kOk,
  kFault,  // there, but something is wrong with it
};

struct DeviceReport {
  std::string name;  // "camera", "ptu", "gnss", "inclinometer", "gpio", "recorder"
  DeviceState state = DeviceState::kAbsent;
  std::string text;                   // what it is when it is well, what is wrong when it is not
  std::optional<double> last_good_s;  // CLOCK_MONOTONIC of the last good datum

  std::string last_error;    // the last trouble in words; empty when there was none
  std::uint64_t errors = 0;  // troubles so far: tells a new one in the same words from an old one

  std::vector<std::string> alarms;         // conditions that hold now, in words
  std::map<std::string, double> readings;  // go up and down; the unit ends the name: "ptu_supply_V"
  std::map<std::string, std::uint64_t> counters;  // only go up; begin with the device's name
};

}  // namespace ols::station
