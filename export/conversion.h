// Converts a recording, or positions from ols-fuse, to one file of a format.
#pragma once

#include <string>

#include "base/process/progress.h"
#include "export/export_config.h"

namespace ols::exports {

struct Conversion {
  std::string log;    // an LCM log; empty: `fixes` is read
  std::string fixes;  // ols-fuse's CSV
  Format format = Format::kGeoJson;
  std::string output;
  bool skips_damage = false;  // damaged parts are skipped and reported
};

struct ConversionReport {
  std::size_t targets = 0, stations = 0, lines = 0;  // records
  std::string damage;  // the skipped parts, with their places; empty: nothing was skipped
};

// Converts everything in the recording, whatever its rate. Tentative targets are written only if
// the gate passes them. Throws std::exception with the file's name if the recording is damaged or
// contains nothing to write; the output is then unchanged. `tell`: progress in bytes of a log.
ConversionReport convert(const Conversion& conversion, const ExportConfig& config,
                         const GateConfig& gate, const TellSteps& tell = {});

}  // namespace ols::exports
