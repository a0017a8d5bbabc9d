// A procedure's options, kept in its folder, so that it can be resumed without repeating them.
#pragma once

#include <string>

#include "tools/calibrate/procedure_commands.h"

namespace ols::calibration {

// JSON.
std::string session_text(const ProcedureOptions& options);
// The options of the interrupted procedure, with the station, state, bus and script of `now`.
// Throws std::runtime_error naming `path`.
ProcedureOptions resumed_options(const std::string& text, const ProcedureOptions& now,
                                 const std::string& path);

}  // namespace ols::calibration
