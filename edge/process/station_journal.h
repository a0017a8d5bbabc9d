// Writes to the journal when a station's alarms, states and faults begin and end, and reports the
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
  // Call with each report. Sets `last_error` in the report. In the first seconds after the start,
  // also removes the alarms of devices that are still starting.
  void note(const clock::ClockPair& now, const Bus& bus, StationReport& report);

 private:
  void hush_what_starts(const clock::ClockPair& now, StationReport& report);
  void note_devices(const StationReport& report, std::int64_t utime_us);
  void note_bus(const Bus& bus, std::int64_t utime_us);

  FaultLog troubles_;
  JournalRateLimit limit_;
  std::optional<double> begun_s_;  // time of the first note()
  const std::string station_;
  const Write write_;
};

}  // namespace ols::station
