// Writes the beginning and end of conditions at a station to the journal, and reports the station's
// newest fault. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/journal/journal_rate_limit.h"
#include "edge/clock/clock_pair.h"
#include "edge/station/fault_log.h"
#include "edge/station/station_report.h"

namespace ols::station {

class StationJournal {
 public:
  using Write = std::function<void(const JournalEvent&)>;

  StationJournal(std::string station, Write write);

  struct Bus {
    std::string url;
    std::string trouble;  // empty if connected
    std::string last_refusal;
    std::uint64_t refusals = 0;
  };
  // Sets the report's last error, and removes alarms of devices that are only starting.
  void note(const clock::ClockPair& now, const Bus& bus, StationReport& report);

 private:
  void hush_what_starts(const clock::ClockPair& now, StationReport& report);
  void note_devices(const StationReport& report, std::int64_t utime_us);
  void note_bus(const Bus& bus, std::int64_t utime_us);

  FaultLog troubles_;
  JournalRateLimit limit_;
  std::optional<double> begun_s_;  // time of the first note
  const std::string station_;
  const Write write_;
};

}  // namespace ols::station
