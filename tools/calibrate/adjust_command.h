// The adjustment of files, for `ols-calibrate adjust` and the procedures.
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

// An adjustment and the results of its stations.
struct Adjusted {
  Case what;
  Calibration found;
  std::vector<StationResult> results;
  Acceptance acceptance;                                      // of the first station
  std::vector<std::pair<std::string, GroupTest>> references;  // those that a person pointed at
  std::vector<RectifiedAngle> angles;                         // of the first station
  std::vector<std::string> notes;                             // remarks and warnings, as sentences
};

// Reads, adjusts and writes the folder. Passes on the errors of its parts, which name file, line
// and key. `tell`: as for calibrate().
Adjusted adjust_into(const CaseOptions& options, const std::filesystem::path& folder,
                     const TellAdjusted& tell = {});

// Everything outside of the limits, for all stations, as sentences; empty: all is within them.
std::vector<std::string> bad_findings(const Adjusted& adjusted);

// One screen for a person: the remaining errors, the rejected references, and the worst one.
AdjustedResult result_for_person(const Adjusted& adjusted);

}  // namespace ols::calibration
