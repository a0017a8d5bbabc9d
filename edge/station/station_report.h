// The content of a station's status message. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/calibration/calibration_status.h"
#include "edge/device/device_report.h"
#include "edge/mount/limits.h"
#include "edge/station/station_types.h"

namespace ols::station {

struct StationReport {
  StationSnapshot snapshot;
  mount::Limits limits;
  bool limits_known = false;
  CalibrationStatus calibration;
  std::vector<device::DeviceReport> devices;
  // Alarms in addition to those of the devices.
  std::vector<Alarm> alarms;
  std::map<std::string, double> readings;
  std::map<std::string, double> counters;

  std::string last_error;  // empty if there was none
  std::int64_t last_error_utime_us = 0;
};

// The alarms of the report and of its devices, without duplicates.
std::vector<Alarm> all_alarms(const StationReport& report);

// One line for a person: the state, the devices that are not OK, the first alarm, and the number of
// further alarms.
std::string in_one_line(const StationReport& report);

}  // namespace ols::station
