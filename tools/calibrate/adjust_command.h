// The adjustment of files, as `ols-calibrate adjust` and the procedures have it done.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "calibration/acceptance.h"
#include "calibration/procedure/field_procedure.h"
#include "calibration/rectification.h"
#include "tools/calibrate/calibrate_case.h"
#include "tools/calibrate/result_files.h"

namespace ols::calibration {

// Of `adjust`: the results are written, and at least one finding is bad.
inline constexpr int kExitNotWithinLimits = 1;

// An adjustment and its station's results.
struct Adjusted {
  Case what;
  Calibration found;
  std::vector<StationResult> results;
  Acceptance acceptance;                                      // of the first station
  std::vector<std::pair<std::string, GroupTest>> references;  // what a person has pointed at
  std::vector<RectifiedAngle> angles;                         // of the first station
  std::vector<std::string> notes;                             // remarks and warnings, as sentences
};

// Reads, adjusts and writes the folder. Throws what its parts throw, naming file, line and key.
// `tell`: as calibrate().
Adjusted adjust_into(const CaseOptions& options, const std::filesystem::path& folder,
                     const TellAdjusted& tell = {});

// What is not within the limits, of all stations, as sentences; empty: all is good.
std::vector<std::string> bad_findings(const Adjusted& adjusted);

// One screen for a person: what is left, what was rejected, what is worst.
AdjustedResult result_for_person(const Adjusted& adjusted);

}  // namespace ols::calibration
