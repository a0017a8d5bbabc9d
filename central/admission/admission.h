// Which bearings are taken: in the order of docs/fusion.md, "Which bearings are taken". Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "central/admission/bearing_check.h"
#include "central/admission/clock_monitor.h"
#include "central/admission/fusion_log.h"
#include "central/admission/message_time.h"
#include "central/admission/station_registry.h"

namespace ols::fusion {

struct AdmissionConfig {
  double min_belief = 0.5;              // bearings believed less are not used
  double stale_s = 1.0;                 // older than "now" by more is refused
  double future_s = 0.5;                // newer than "now" by more is refused
  double flood_hz = 1000.0;             // more bearings of one station are refused
  std::vector<std::string> stations{};  // nobody else's bearings are taken; empty: anybody's
  int max_stations = 1024;  // one more takes the place of the one that is silent longest;
                            // never of one that has delivered and still does
  double silence_s = Activity::kDeliversS;  // who is silent for longer does not count for "now"
  ClockMonitorConfig clocks{};
};

// What became of a bearing, and what else is to be forgotten by it.
struct Admitted {
  BearingRefusal refusal = BearingRefusal::kNone;
  KnownStation* station = nullptr;       // whose bearing was taken
  std::optional<std::string> evicted{};  // this station gave its place to the bearing's
  bool recalibrated = false;             // the station's systematic errors are other ones,
  bool restarted = false;                // and its process numbers its objects anew
};

class Admission {
 public:
  explicit Admission(const AdmissionConfig& config);

  Admitted admit(const BearingMeasurement& sighting, FusionLog& log);
  // What a station's status tells. Who gave way to it.
  std::optional<std::string> know_station(const std::string& station, const StationTraits& traits,
                                          FusionLog& log);
  void allow_slews(const std::string& station, bool allowed);
  // Another time line: what was judged by the old one is forgotten.
  void begin_time_line();

  // Ahead of "now" by more than is taken.
  bool is_future(std::int64_t utime_us) const;
  const MessageTime& time() const { return time_; }
  const ClockMonitor& clocks() const { return clocks_; }
  const StationRegistry& stations() const { return registry_; }

 private:
  BearingRefusal judge(const BearingMeasurement& sighting, KnownStation& station, FusionLog& log);
  bool clock_is_believed(const BearingMeasurement& sighting, FusionLog& log);
  BearingRefusal store(const BearingMeasurement& sighting, KnownStation& station) const;
  static void notice_changes(const BearingMeasurement& sighting, FusionLog& log,
                             Admitted& admitted);
  void evict(const std::string& station, FusionLog& log);

  AdmissionConfig config_;
  StationRegistry registry_;
  MessageTime time_;
  ClockMonitor clocks_;
};

}  // namespace ols::fusion
