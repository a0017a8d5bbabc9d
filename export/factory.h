// Makes an output's encoder and outlet from its configuration.
#pragma once

#include <memory>

#include "export/encoder.h"
#include "export/export_config.h"
#include "export/files/picture.h"
#include "export/outlet/outlet.h"
#include "export/output.h"

namespace ols::exports {

std::unique_ptr<Output> make_output(const OutputConfig& output, const ExportConfig& config);

// Makes the encoder for a file of a whole recording: its history is unlimited, and it writes no
// companion files.
std::unique_ptr<Encoder> make_file_encoder(Format format, const ExportConfig& config);

}  // namespace ols::exports
