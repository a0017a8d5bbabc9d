#include "edge/station/station_report.h"

#include <algorithm>

namespace ols::station {

std::vector<Alarm> all_alarms(const StationReport& report) {
  std::vector<Alarm> all;
  const auto add = [&all](const std::vector<Alarm>& alarms) {
    for (const Alarm& alarm : alarms) {
      if (std::ranges::find(all, alarm) == all.end()) all.push_back(alarm);
    }
  };
  add(report.alarms);
  for (const device::DeviceReport& device : report.devices) add(device.alarms);
  return all;
}

std::string in_one_line(const StationReport& report) {
  std::string line = to_string(report.snapshot.state);
  for (const device::DeviceReport& device : report.devices) {
    if (device.state == device::DeviceState::kOk) continue;
    line += "; " + device.name + " " + to_string(device.state);
  }
  const auto alarms = all_alarms(report);
  if (!alarms.empty()) line += "; " + alarms.front().text;
  if (alarms.size() > 1) line += " and " + std::to_string(alarms.size() - 1) + " more alarms";
  return line;
}

}  // namespace ols::station
