// Judges which stations' clocks are credible, by two measures: the error that a station states, and
// the offset of its stamps from those of the other stations. Pure.
//
// The fusion does not use the bearings of a quarantined station, and does not count the station in
// its "now". The others continue without it. A clock error below the limit only inflates the
// station's covariance along the target's motion.
//
// A station is quarantined for either of two reasons:
//  - It states an error beyond error_limit_s while most others state less. (If no station has a
//    better clock, none is quarantined: the covariances account for the errors.)
//  - Its stamps differ by more than offset_limit_s from the median of all stations' newest stamps.
//    This needs three stations: with two, nobody can tell which clock is wrong. Late messages look
//    like a slow clock, so only the offset common to all stamps of the last second counts.
//
// The quarantine ends when neither reason has held for release_s; tighter limits apply then.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "central/admission/message_time.h"
#include "central/measurement/bearing_measurement.h"
#include "conditions/alarm.h"

namespace ols::fusion {

struct ClockMonitorConfig {
  double error_limit_s = 0.1;    // 1-sigma as stated by the station
  double offset_limit_s = 0.4;   // offset from the median
  double usual_offset_s = 0.15;  // offset that frame phases and network delays explain
  double release_s = 3.0;
  int stamps = 15;  // number of stamps per station that are compared
};

class ClockMonitor {
 public:
  explicit ClockMonitor(const ClockMonitorConfig& config = {}) : config_(config) {}

  // Takes a bearing; `time` must have taken its stamp already.
  void hear(const BearingMeasurement& measurement, const MessageTime& time);
  // Why a station is quarantined; empty if it is not.
  const Alarm& quarantine(const std::string& station) const;
  // The amount added to the 1-sigma of a station's stamps because they are offset from the others'.
  double added_sd_s(const std::string& station) const;
  // The recent offset of a station's stamps from the median: 0 within usual_offset_s, NaN before
  // the first stamp.
  double offset_s(const std::string& station) const;
  void forget(const std::string& station) { stations_.erase(station); }
  void clear() { stations_.clear(); }

 private:
  struct Station {
    double error_s = 0.0;
    bool synchronised = false;
    std::deque<double> offsets_s;
    Alarm quarantine;
    double bad_s = 0.0;  // MessageTime's elapsed time at the last bad stamp
  };

  // The offset common to all recent stamps.
  double common_offset_s(const Station& station) const;
  bool others_are_better(const std::string& station, const MessageTime& time) const;
  Alarm judge(const std::string& name, const Station& station, const MessageTime& time) const;

  ClockMonitorConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
