// The station's own computer: temperature of its processor, room on its disk, turns of the control
// loop that took too long.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ols {

struct HostConfig {
  std::string thermal_folder = "/sys/class/thermal";
  std::string disk_folder = "/";  // of the file system whose room is watched
  double cpu_alarm_degC = 85.0;
  double disk_alarm_bytes = 5e8;
  double slow_turn_s = 0.5;  // a turn of the control loop that takes longer is counted
};

struct HostReport {
  std::map<std::string, double> readings;
  std::vector<std::string> alarms;
};

class HostWatch {
 public:
  explicit HostWatch(const HostConfig& config) : config_(config) {}

  void note_turn(double seconds);
  // Reads anew; some tens of microseconds.
  HostReport look();
  std::uint64_t slow_turns() const { return slow_turns_; }

 private:
  HostConfig config_;
  double slowest_s_ = 0.0;  // since the last look
  std::uint64_t slow_turns_ = 0;
};

}  // namespace ols
