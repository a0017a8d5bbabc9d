// What a procedure was asked for, kept in its folder: whoever goes on with it need not say it
// again.
#pragma once

#include <string>

#include "tools/calibrate/procedure_commands.h"

namespace ols::calibration {

// JSON.
std::string session_text(const ProcedureOptions& options);
// The options of the interrupted procedure; station, state, bus and script are those of `now`.
// std::runtime_error naming `path`.
ProcedureOptions resumed_options(const std::string& text, const ProcedureOptions& now,
                                 const std::string& path);

}  // namespace ols::calibration
