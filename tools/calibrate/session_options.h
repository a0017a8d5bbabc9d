// A procedure's options, stored in its folder: a person who resumes it need not repeat them.
#pragma once

#include <string>

#include "tools/calibrate/procedure_commands.h"

namespace ols::calibration {

// The options as JSON.
std::string session_text(const ProcedureOptions& options);
// The options of the interrupted procedure, with the station, state folder, bus and script of
// `now`. Throws std::runtime_error naming `path`.
ProcedureOptions resumed_options(const std::string& text, const ProcedureOptions& now,
                                 const std::string& path);

}  // namespace ols::calibration
