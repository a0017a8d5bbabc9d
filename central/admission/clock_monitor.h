// Which stations' clocks can be believed: what each says of its own clock, and how its stamps stand
// to those of the others. Pure.
//
// A station whose clock cannot be believed is quarantined: its bearings are not used, it does not
// count for the fusion's "now", and the others go on without it. A smaller doubt only inflates its
// covariance along the target's motion.
//
//  - By its own mark: it states an error beyond error_limit_s while most of the others state less.
//    (Where nobody has a better clock, the errors are in the covariances and nobody is set aside.)
//  - By comparison, from three stations on: its stamps lie ahead of the median of all stations'
//    newest stamps by more than offset_limit_s, or behind it. Late messages look as a slow clock
//    does, so that only what all stamps of the last second share counts, and a station that is
//    synchronised is not judged by being late. Two stations cannot be told apart.
//
// The quarantine ends when for release_s nothing of this has held, by tighter limits.
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
  double usual_offset_s = 0.15;  // what phases of frames and ways of messages explain
  double release_s = 3.0;
  int stamps = 15;  // of a station that are compared
};

class ClockMonitor {
 public:
  explicit ClockMonitor(const ClockMonitorConfig& config = {}) : config_(config) {}

  // A bearing that `time` has heard already.
  void hear(const BearingMeasurement& sighting, const MessageTime& time);
  // Why a station is quarantined, in words; empty when it is not.
  const std::string& quarantine(const std::string& station) const;
  // What to add to the 1-sigma of a station's stamps for being off the others' time.
  double added_sd_s(const std::string& station) const;
  // Of its stamps from the median lately, 0 within what is usual; NaN before the first.
  double offset_s(const std::string& station) const;
  void forget(const std::string& station) { stations_.erase(station); }
  void clear() { stations_.clear(); }

 private:
  struct Station {
    double error_s = 0.0;
    bool synchronised = false;
    std::deque<double> offsets_s;
    std::string quarantine;
    double bad_s = 0.0;  // MessageTime's elapsed time when it was bad last
  };

  // The offset that all of the last stamps share.
  double common_offset_s(const Station& station) const;
  bool others_are_better(const std::string& station, const MessageTime& time) const;
  std::string judge(const std::string& name, const Station& station, const MessageTime& time) const;

  ClockMonitorConfig config_;
  std::map<std::string, Station> stations_;
};

}  // namespace ols::fusion
