// The output files of an adjustment: instrument, setup, covariance, reports, predictions.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calibration/acceptance.h"
#include "calibration/calibrate.h"
#include "tools/calibrate/calibrate_case.h"
#include "tools/calibrate/output_folder.h"

namespace ols::calibration {

// The result of one station, as in its files.
struct StationResult {
  std::string id;
  std::int64_t calibration_id = 0;  // derived from the content of the files
  StationState state;
  StationMatrix prior_covariance, covariance;
  Acceptance acceptance;
  std::string instrument, setup, covariance_csv;  // the content of the files
};
std::vector<StationResult> station_results(const Case& what, const Adjustment& adjustment,
                                           const Calibration& found);

// Throws CsvError for a row that cannot be predicted.
std::string predictions(const Case& what, const std::vector<StationResult>& results);

std::string report_json(const Case& what, const Adjustment& adjustment, const Calibration& found,
                        const std::vector<StationResult>& results);
std::string report_html(const Case& what, const Adjustment& adjustment, const Calibration& found,
                        const std::vector<StationResult>& results);

// All files of an adjustment. Throws CsvError for a row that cannot be predicted.
std::vector<OutputFile> output_files(const Case& what, const Adjustment& adjustment,
                                     const Calibration& found);

}  // namespace ols::calibration
