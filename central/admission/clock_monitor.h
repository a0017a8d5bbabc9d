// Decides which stations' clocks are credible, from the error that each station states, and from
// the offset of its stamps from those of the other stations. Pure.
//
// The fusion does not use the bearings of a quarantined station, and leaves its stamps out of the
// median "now". The other stations continue. A clock error below the limit only inflates the
// station's covariance along the target's motion.
//
// A station is quarantined for either of two reasons:
//  - It states an error above error_limit_s while most other stations state a smaller one. (If most
//    stations have clocks as bad as this one, this station is not quarantined: the covariances
//    account for the errors.)
//  - Its stamps differ by more than offset_limit_s from the median of all stations' newest stamps.
//    This needs three stations: with two, the wrong clock cannot be identified. A late message
//    looks like a slow clock. The offset is therefore the smallest one among the station's last
//    stamps; and a station that reports a synchronised clock is not quarantined for being behind.
//
// The quarantine ends when neither reason has applied for release_s. While a station is
// quarantined, both limits are reduced to 0.7 times their values.
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
  double usual_offset_s = 0.15;  // offsets up to this come from frames' phases and network delays
  double release_s = 3.0;
  int stamps = 15;  // number of stamps per station that are compared
};

class ClockMonitor {
 public:
  explicit ClockMonitor(const ClockMonitorConfig& config = {}) : config_(config) {}

  // Takes a bearing. MessageTime::hear() must have taken its stamp before.
  void hear(const BearingMeasurement& measurement, const MessageTime& time);
  // Why a station is quarantined; empty if it is not.
  const Alarm& quarantine(const std::string& station) const;
  // The amount to add to the 1-sigma of a station's stamps, because they are offset from those of
  // the other stations. 0 if the station reports a synchronised clock.
  double added_sd_s(const std::string& station) const;
  // The recent offset of a station's stamps from the median; NaN before the first stamp.
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

  // The smallest of the offsets of the last `stamps` stamps; 0 if these offsets differ in sign, or
  // if there are fewer than `stamps`.
  double common_offset_s(const Station& station) const;
  bool others_are_better(const std::string& station, const MessageTime& time) const;
  Alarm judge(const std::string& name, const Station& station, const MessageTime& time) const;

  ClockMonitorConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
