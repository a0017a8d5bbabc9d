// Decides which bearings are admitted, in the order of docs/fusion.md, section 1. Pure.
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
  double min_belief = 0.5;              // bearings with a lower belief are not used
  double stale_s = 1.0;                 // largest age relative to "now"
  double future_s = 0.5;                // largest lead over "now"
  double flood_hz = 1000.0;             // largest rate of bearings from one station
  std::vector<std::string> stations{};  // only these stations are admitted; if empty, all are
  // When this number of stations is reached, a new station replaces another one
  // (station_registry.h).
  int max_stations = 1024;
  // A station that has been silent for longer than this does not count in the median that gives
  // "now" (message_time.h).
  double silence_s = Activity::kDeliversS;
  ClockMonitorConfig clocks{};
};

// The fate of a bearing. Also those changes of its station that oblige the fusion to forget
// something that it knew about the station.
struct Admitted {
  BearingRefusal refusal = BearingRefusal::kNone;
  KnownStation* station = nullptr;       // the sender of an admitted bearing
  std::optional<std::string> evicted{};  // the station that was replaced
  bool recalibrated = false;             // the station has a new calibration_id
  bool restarted = false;  // the station's process has restarted and numbers its tracks anew
};

class Admission {
 public:
  explicit Admission(const AdmissionConfig& config);

  Admitted admit(const BearingMeasurement& measurement, FusionLog& log);
  // Takes a station's status; returns the station that it replaced.
  std::optional<std::string> know_station(const std::string& station, const StationTraits& traits,
                                          FusionLog& log);
  void allow_slews(const std::string& station, bool allowed);
  // Notes that the station sees this target. If its detector sees several targets, the first target
  // is kept until the detector no longer sees it.
  void note_target(const BearingMeasurement& measurement, std::int64_t target_id);
  // Called when message time was reset. Forgets every judgement that was based on the old time.
  void begin_time_line();

  // Whether the instant is more than future_s ahead of "now".
  bool is_future(std::int64_t utime_us) const;
  const MessageTime& time() const { return time_; }
  const ClockMonitor& clocks() const { return clocks_; }
  const StationRegistry& stations() const { return registry_; }

 private:
  BearingRefusal judge(const BearingMeasurement& measurement, KnownStation& station,
                       FusionLog& log);
  bool clock_is_believed(const BearingMeasurement& measurement, FusionLog& log);
  BearingRefusal store(const BearingMeasurement& measurement, KnownStation& station) const;
  static void notice_changes(const BearingMeasurement& measurement, FusionLog& log,
                             Admitted& admitted);
  void evict(const std::string& station, FusionLog& log);

  AdmissionConfig config_;
  StationRegistry registry_;
  MessageTime time_;
  ClockMonitor clocks_;
};

}  // namespace ols::fusion
