// A station's drift, from check to check: a finding counts once a second check confirms it, and is
// never used as a correction. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "edge/drift/drift_finding.h"

namespace ols::station {

enum class DriftLevel { kNone, kAmber, kRed };

class DriftWatch {
 public:
  struct Config {
    double amber_rad = 20.0 * 3.14159265358979323846 / 648000.0;
    double red_rad = 40.0 * 3.14159265358979323846 / 648000.0;
  };
  // `calibration_id`: of the calibration that the stored views belong to.
  DriftWatch(const Config& config, std::int64_t calibration_id)
      : config_(config), calibration_id_(calibration_id) {}

  // The result of a check. True: look again at once, before anything is said.
  bool add(const DriftFinding& finding);

  DriftLevel level() const { return level_; }
  // The views agreed on nothing: by how much it has turned is not known.
  bool is_unclear() const { return finding_.cause == DriftCause::kUnclear; }
  // What bearings must allow for, 1-sigma; zero without an alarm.
  double heading_doubt_rad() const;
  double tilt_doubt_rad() const;
  // Incremented when these have changed.
  int revision() const { return revision_; }
  // In words, with what to do; empty: nothing.
  std::string alarm() const;

  // One line, for a file; restore() takes it back if it is of the same calibration, and returns
  // false for a line that it cannot read.
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
  DriftFinding finding_;  // that of level_
  bool suspected_ = false;
  int quiet_ = 0;  // checks in a row
  int revision_ = 0;
};

}  // namespace ols::station
