// Monitors the station's computer: processor temperature, free disk space, and slow cycles of the
// control loop. (Here, a cycle is called a turn.) It reads temperature and disk in its own thread,
// because a hanging network disk must not block the control loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"

namespace ols::station {

struct HostConfig {
  std::string thermal_folder = "/sys/class/thermal";
  std::string disk_folder = "/";  // a folder on the file system whose free space is monitored
  double cpu_alarm_degC = 85.0;
  double disk_alarm_bytes = 5e8;
  double interval_s = 2.0;  // time between two readings
  double silence_s = 10.0;  // an alarm is raised after this time without a reading
};

struct HostReport {
  std::map<std::string, double> readings;
  std::vector<Alarm> alarms;
};

// One reading of the computer's sensors; nullopt for a value that cannot be read.
struct HostReading {
  std::optional<double> cpu_degC;
  std::optional<double> disk_free_bytes;
};
HostReading read_host(const HostConfig& config);
HostReport report_on(const HostReading& reading, const HostConfig& config);

class HostMonitor {
 public:
  using Reader = std::function<HostReading()>;
  // Starts to read periodically. Objects that `reader` refers to must live until the program ends,
  // because the thread may outlive this object.
  explicit HostMonitor(const HostConfig& config)
      : HostMonitor(config, [c = config] { return read_host(c); }) {}
  HostMonitor(const HostConfig& config, Reader reader);
  ~HostMonitor();  // does not wait for a reading in progress
  HostMonitor(const HostMonitor&) = delete;
  HostMonitor& operator=(const HostMonitor&) = delete;

  // Notes the duration of a turn. `waited_s`: the part of `seconds` in which the turn waited for a
  // frame.
  void note_turn(double seconds, double waited_s = 0.0);
  // The report for the status message, from the newest reading and the turns; never waits. `now_s`:
  // CLOCK_MONOTONIC.
  HostReport look(double now_s);
  std::uint64_t slow_turns() const { return slow_turns_; }

 private:
  struct Shared;                              // shared with the thread
  static constexpr std::size_t kKept = 1000;  // number of turns, about ten seconds

  double turn_p99_s() const;

  HostConfig config_;
  std::shared_ptr<Shared> shared_;
  double slowest_s_ = 0.0;  // slowest turn since the last report
  // Durations of the last turns; if full, the oldest is at turns_ % kKept.
  std::vector<double> turns_s_;
  std::uint64_t turns_ = 0;
  std::uint64_t slow_turns_ = 0;
};

}  // namespace ols::station
