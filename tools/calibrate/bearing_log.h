// Reads the stations' bearings (channels OLS_BEARING_*) from recordings of the bus.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibration/delay_fit.h"

namespace ols::calibration {

// Bearings of several stations, in the east-north-up frame at one of their cameras.
struct BearingLog {
  std::vector<std::string> stations;
  std::vector<LastingErrors> errors;    // of each station, as stated: means of its bearings
  std::vector<std::size_t> by_arrival;  // of each station: bearings with times by arrival
  std::vector<TimedBearing> bearings;   // each once, even if several recordings contain it
  std::size_t unusable = 0;             // malformed, of another schema, or with impossible values
  std::size_t unsynchronised = 0;       // the station's clock was not synchronised
  std::size_t disbelieved = 0;          // the tracker's belief was too low
  std::vector<std::string> damage;      // one text per damaged recording
};

// Throws std::runtime_error naming a file that cannot be read.
BearingLog read_bearings(const std::vector<std::string>& recordings);

}  // namespace ols::calibration
