// Converts a recording, or the positions that ols-fuse has computed, to one file.
#pragma once

#include <string>

#include "base/process/progress.h"
#include "export/export_config.h"

namespace ols::exports {

struct Conversion {
  std::string log;    // path of an LCM log; empty: `fixes` is read
  std::string fixes;  // path of a CSV file of ols-fuse
  Format format = Format::kGeoJson;
  std::string output;
  bool skips_damage = false;  // skips damaged parts and reports them; false: damage is an error
};

struct ConversionReport {
  std::size_t targets = 0, stations = 0, lines = 0;  // numbers of records written
  std::string damage;  // the skipped parts, with their places; empty: nothing was skipped
};

// Converts everything in the recording that the gate passes. Throws an exception that names the
// file if the recording is damaged or contains nothing to write; the output is then unchanged.
// `tell` receives the progress, in bytes of the log.
ConversionReport convert(const Conversion& conversion, const ExportConfig& config,
                         const GateConfig& gate, const TellSteps& tell = {});

}  // namespace ols::exports
