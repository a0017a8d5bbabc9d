// A recording, or positions from ols-fuse, as one file of a format.
#pragma once

#include <string>

#include "base/progress.h"
#include "export/export_config.h"

namespace ols::exports {

struct Conversion {
  std::string log;    // an LCM log; or
  std::string fixes;  // the CSV that ols-fuse writes
  Format format = Format::kGeoJson;
  std::string output;
  bool skips_damage = false;  // what is damaged is left out and reported
};

struct ConversionReport {
  std::size_t targets = 0, stations = 0, lines = 0;  // records
  std::string damage;  // that was left out, with its places; empty: none
};

// Everything in the recording, whatever its rate; tentative targets only where the gate lets them.
// Throws std::exception with the file's name, and leaves the output as it was: also where the
// recording is damaged, or there is nothing in it to write. `tell`: of a log's bytes.
ConversionReport convert(const Conversion& conversion, const ExportConfig& config,
                         const GateConfig& gate, const TellSteps& tell = {});

}  // namespace ols::exports
