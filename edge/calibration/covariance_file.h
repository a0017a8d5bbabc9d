// covariance.csv: the covariance of an instrument's parameters, beside its instrument.toml.
#pragma once

#include <string>

#include "calibration/parameters.h"

namespace ols::calibration {

// The instrument's part of a covariance, from the units of the file. CsvError "FILE:LINE: key:
// what" unless every parameter has one row and one column, and the matrix is a covariance:
// symmetric, and its correlations positive definite. A variance of 0 is a value that is known.
InstrumentMatrix read_covariance(const std::string& path);
// The same of all parameters of a station.
StationMatrix read_station_covariance(const std::string& path);

}  // namespace ols::calibration
