// Which stations' clocks are credible, by what each states of its own clock and by its stamps
// compared with those of the others. Pure.
//
// The bearings of a quarantined station are not used, and it does not count for the fusion's "now";
// the others continue without it. A smaller clock error only inflates its covariance along the
// target's motion.
//
//  - By its own statement: it states an error beyond error_limit_s while most others state less.
//    (Where no station has a better clock, the covariances contain the errors and none is
//    quarantined.)
//  - By comparison, from three stations on: its stamps are ahead of or behind the median of all
//    stations' newest stamps by more than offset_limit_s. Late messages look like a slow clock.
//    Only the offset common to all stamps of the last second counts, so a synchronised station is
//    not quarantined for delays. Of two stations, it is unknown which one is wrong.
//
// The quarantine ends when neither has held for release_s, by tighter limits.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "central/admission/message_time.h"
#include "central/measurement/bearing_measurement.h"

namespace ols::fusion {

struct ClockMonitorConfig {
  double error_limit_s = 0.1;    // stated 1-sigma
  double offset_limit_s = 0.4;   // from the median
  double usual_offset_s = 0.15;  // that frame phases and network delays explain
  double release_s = 3.0;
  int stamps = 15;  // of a station, to compare
};

class ClockMonitor {
 public:
  explicit ClockMonitor(const ClockMonitorConfig& config = {}) : config_(config) {}

  // A bearing that `time` has already taken.
  void hear(const BearingMeasurement& measurement, const MessageTime& time);
  // Why a station is quarantined, as text; empty when it is not.
  const std::string& quarantine(const std::string& station) const;
  // What to add to the 1-sigma of a station's stamps because they are offset from the others'.
  double added_sd_s(const std::string& station) const;
  // Recent offset of its stamps from the median, 0 within usual_offset_s; NaN before the first.
  double offset_s(const std::string& station) const;
  void forget(const std::string& station) { stations_.erase(station); }
  void clear() { stations_.clear(); }

 private:
  struct Station {
    double error_s = 0.0;
    bool synchronised = false;
    std::deque<double> offsets_s;
    std::string quarantine;
    double bad_s = 0.0;  // MessageTime's elapsed time when it was last bad
  };

  // The offset common to all recent stamps.
  double common_offset_s(const Station& station) const;
  bool others_are_better(const std::string& station, const MessageTime& time) const;
  std::string judge(const std::string& name, const Station& station, const MessageTime& time) const;

  ClockMonitorConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
