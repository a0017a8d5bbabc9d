// Reads files, adjusts and writes the results, for `ols-calibrate adjust` and the procedures.
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
  Acceptance acceptance;  // of the first station
  // The references at which a person pointed.
  std::vector<std::pair<std::string, GroupTest>> references;
  std::vector<RectifiedAngle> angles;  // of the first station
  std::vector<std::string> notes;      // remarks and warnings, as sentences
};

// Reads the files, adjusts, and writes the results into `folder`. Throws what its parts throw;
// their errors name file, line and key. `tell`: as for calibrate().
Adjusted adjust_into(const CaseOptions& options, const std::filesystem::path& folder,
                     const TellAdjusted& tell = {});

// What is outside of the limits, for all stations, as sentences; empty: nothing.
std::vector<std::string> bad_findings(const Adjusted& adjusted);

// One screen of text for a person: the remaining errors, the rejected references, and the reference
// with the largest deviation.
AdjustedResult result_for_person(const Adjusted& adjusted);

}  // namespace ols::calibration
