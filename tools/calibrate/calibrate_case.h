// Reads and checks the input files of an adjustment by ols-calibrate.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "calibration/groups.h"
#include "edge/calibration/instrument_file.h"
#include "tools/calibrate/ut1_value.h"

namespace ols::calibration {

struct CaseOptions {
  std::vector<std::string> stations;     // configurations, as ols-station reads them
  std::vector<std::string> instruments;  // no files, or one per station
  std::vector<std::string> observations;
  std::string references, predict, output;
  Ut1Value ut1;
  std::optional<double> resolution_arcsec;  // size of a count, as the units report it
  std::optional<double> pressure_hPa, temperature_degC;
  // 1-sigma of the clock that stamped the sightings of stars and sun.
  std::optional<double> clock_sd_s;
};

struct Case {
  CaseOptions options;
  std::vector<Instrument> instruments;  // before the adjustment
  Problem problem;
  std::vector<std::string> warnings;
  std::vector<std::string> files;  // the file of each observation
  std::set<std::size_t> mistaken;  // indices of the observations that are not used
};

// The instrument with which a new setup begins. Values of an earlier calibration (with a covariance
// in the file) get a larger uncertainty, because transport may change them: 30 arc seconds for the
// camera on its plate, 4 arc seconds for the axes. Values that a person states keep their
// uncertainty.
Instrument carried_instrument(const std::string& path, const Instrument& fallback);

// The station's state before an adjustment. Throws std::invalid_argument if the station's position
// is not surveyed.
StationPrior prior_of(const station::StationSettings& settings, const Instrument& instrument,
                      const std::string& path);
// Reads landmarks, stars and trajectories from a file; with an empty path there are none. Throws
// CsvError.
References references_in(const std::string& path);

// Reads the stations, without observations.
Case read_stations(const CaseOptions& options);
// Reads everything. Throws ConfigError, CsvError or std::runtime_error naming file, line and key;
// std::invalid_argument.
Case read_case(const CaseOptions& options);

// The network of the case, without the mistaken observations. Errors name the file and line of the
// refused observation.
Network network_of(const Case& what);

// Finds single sightings of drones, aircraft and tracks that contradict all other observations.
// `tell`: as for calibrate().
void find_mistaken(Case& what, const TellAdjusted& tell = {});
// One sentence for each of the first few mistaken observations, with file and line.
std::vector<std::string> mistaken_in_words(const Case& what);

}  // namespace ols::calibration
