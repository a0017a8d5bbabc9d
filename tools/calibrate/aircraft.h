// ols-calibrate aircraft: what a receiver has heard of aircraft, as rows of references.csv.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "calibration/adsb.h"

namespace ols::calibration {

struct AircraftOptions {
  std::vector<std::string> inputs;  // files, or HOST:PORT
  std::string format, output;
  double sd_m = 10.0;
  double duration_s = 600.0;                   // of a connection
  std::optional<std::int64_t> start_utime_us;  // of a Beast file's first frame
  bool heights_are_geometric = false;          // SBS says nothing of its heights
  bool clock_is_right = false;                 // a person's word, where no time service says so
};

// In words what is wrong with the clock of a receiver that stamps by itself; empty: nothing.
// `least_delay_us`: ReceiverDelay.
std::string receiver_clock_trouble(std::int64_t least_delay_us);

// The rows, by aircraft and time. One that was not heard for half a minute comes back under another
// name, one that was heard once does not come at all.
std::string reference_rows(std::vector<AircraftPosition> positions, double sd_m);

// Reads, writes, and returns what a person should know. std::runtime_error naming input or option.
// `tell`: of the bytes of all inputs, and while a receiver is silent.
std::vector<std::string> write_aircraft(const AircraftOptions& options, const TellSteps& tell = {});

}  // namespace ols::calibration
