// ols-calibrate aircraft: positions from an aircraft receiver, as rows of references.csv.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/process/progress.h"
#include "calibration/adsb.h"
#include "tools/calibrate/command_report.h"

namespace ols::calibration {

struct AircraftOptions {
  std::vector<std::string> inputs;  // files, or HOST:PORT
  std::string format, output;
  double sd_m = 10.0;
  double duration_s = 600.0;                   // for how long a connection is read
  std::optional<std::int64_t> start_utime_us;  // of the first frame in a Beast file
  // For SBS, which does not say what its heights are: a person states that they are above the
  // ellipsoid.
  bool heights_are_geometric = false;
  // A person states that this host's clock is right, if no time service confirms it.
  bool clock_is_right = false;
};

// The clock error of a receiver that stamps its messages, in words; empty: no error was found.
// `least_delay_us`: from ReceiverDelay.
std::string receiver_clock_trouble(std::int64_t least_delay_us);

// The rows, sorted by aircraft and time. An aircraft that was silent for half a minute gets a new
// name. An aircraft with only one position is left out.
std::string reference_rows(std::vector<AircraftPosition> positions, double sd_m);

// Reads the inputs and writes the output. Throws std::runtime_error naming input or option. `tell`:
// receives the progress in bytes of all inputs, also while a receiver is silent.
CommandReport write_aircraft(const AircraftOptions& options, const TellSteps& tell = {});

}  // namespace ols::calibration
