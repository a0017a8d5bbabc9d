// Reads the folder that `ols-calibrate adjust` writes (docs/calibration.md), for the station to
// which it belongs.
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
  // 1-sigma per axis of the systematic error of a direction, over the working volume: root mean
  // square and maximum.
  double rms_rad = 0.0, worst_rad = 0.0;
};

// A hash (FNV-1a) of the contents of the three files, as a non-negative number. `setup`: without
// the lines up to and including the one with the id.
std::int64_t calibration_id_of(std::string_view instrument, std::string_view setup,
                               std::string_view covariance);

// Reads the folder. Throws ConfigError, CsvError, std::invalid_argument or std::system_error,
// naming file, line and key, in these cases: something is missing or malformed; a file was edited
// after the adjustment; the folder is from another station; or serial numbers differ from the
// configuration's.
CalibrationFiles read_calibration(const std::string& folder, const StationSettings& settings);

// Returns the settings of a station that uses this calibration. The calibration's setup replaces
// the surveyed pose; sensors are used only to check it.
StationSettings with_calibration(StationSettings settings, const CalibrationFiles& files);

}  // namespace ols::station
