// covariance.csv, next to instrument.toml: the covariance of an instrument's parameters.
#pragma once

#include <string>

#include "calibration/parameters.h"

namespace ols::calibration {

// Reads the instrument's part of a covariance, in internal units. Throws CsvError "FILE:LINE: key:
// what" unless every parameter has one row and one column, and the matrix is a covariance:
// symmetric, with positive definite correlations. A variance of 0 means that the value is known
// exactly.
InstrumentMatrix read_covariance(const std::string& path);
// As above, for all parameters of a station.
StationMatrix read_station_covariance(const std::string& path);

}  // namespace ols::calibration
