// Follows a station's drift from one check of its reference views to the next. A finding counts
// only after a second check has confirmed it. A finding never corrects angles. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "conditions/alarm.h"
#include "edge/calibration/drift_finding.h"

namespace ols::station {

enum class DriftLevel { kNone, kAmber, kRed };

class DriftWatch {
 public:
  struct Config {
    double amber_rad = 20.0 * 3.14159265358979323846 / 648000.0;
    double red_rad = 40.0 * 3.14159265358979323846 / 648000.0;
  };
  // `calibration_id`: the calibration at which the views were stored.
  DriftWatch(const Config& config, std::int64_t calibration_id)
      : config_(config), calibration_id_(calibration_id) {}

  // Takes the result of a check. Returns true if another check must follow at once, before anything
  // is reported.
  bool add(const DriftFinding& finding);

  DriftLevel level() const { return level_; }
  // Whether the views contradicted each other, so that the turn is unknown.
  bool is_unclear() const { return finding_.cause == DriftCause::kUnclear; }
  // The 1-sigma that bearings must add; zero if there is no alarm.
  double heading_doubt_rad() const;
  double tilt_doubt_rad() const;
  // Is incremented at each change of the doubt.
  int revision() const { return revision_; }
  // The alarm that names the finding and what to do; empty if there is none.
  Alarm alarm() const;

  // to_text() gives the state as one line for a file. restore() takes the state from such a line,
  // unless the line belongs to another calibration. It returns false if it cannot read the line.
  std::string to_text() const;
  bool restore(const std::string& text);

 private:
  double size_rad(const DriftFinding& finding) const;
  DriftLevel judge(const DriftFinding& finding) const;
  bool stays() const;
  void take(DriftLevel level, const DriftFinding& finding);

  Config config_;
  std::int64_t calibration_id_;
  DriftLevel level_ = DriftLevel::kNone;
  DriftFinding finding_;  // the finding that led to level_
  bool suspected_ = false;
  int quiet_ = 0;  // number of consecutive checks without a finding
  int revision_ = 0;
};

}  // namespace ols::station
