// Reads covariance.csv, next to instrument.toml: the covariance of an instrument's parameters.
#pragma once

#include <string>

#include "calibration/parameters.h"

namespace ols::calibration {

// Reads the instrument's part of a covariance, in internal units. A variance of 0 means that the
// value is known exactly. Every parameter must have one row and one column; only k3 and k4 may be
// missing, and then count as known exactly. The matrix must be a covariance: symmetric, with
// positive definite correlations. Otherwise throws CsvError "FILE:LINE: key: what".
InstrumentMatrix read_covariance(const std::string& path);
// Likewise, for all parameters of a station.
StationMatrix read_station_covariance(const std::string& path);

}  // namespace ols::calibration
