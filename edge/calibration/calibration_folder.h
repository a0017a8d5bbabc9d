// The folder that `ols-calibrate adjust` writes (docs/calibration.md), as its station reads it.
// This file reads from disk.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "edge/config/config.h"
#include "geometry/station_calibration.h"

namespace ols::station {

struct CalibrationFiles {
  StationCalibration calibration;
  InstrumentSerials serials;
  std::int64_t id = 0;  // computed from the content
  // Time of the last observation; 0 if the observations had no times.
  std::int64_t observed_utime_us = 0;
  // 1-sigma of the systematic error of a direction over the working volume, per axis.
  double rms_rad = 0.0, worst_rad = 0.0;
};

// FNV-1a of the three files, as a non-negative number. The setup's lines up to and including the id
// are left out.
std::int64_t calibration_id_of(std::string_view instrument, std::string_view setup,
                               std::string_view covariance);

// Throws ConfigError, CsvError, std::invalid_argument or std::system_error, naming file, line and
// key, if anything is missing, malformed, edited afterwards, from another station, or has other
// serial numbers than the configuration.
CalibrationFiles read_calibration(const std::string& folder, const StationSettings& settings);

// Returns the settings of a station with this calibration. The calibration's setup replaces the
// surveyed pose; sensors only check it.
StationSettings with_calibration(StationSettings settings, const CalibrationFiles& files);

}  // namespace ols::station
