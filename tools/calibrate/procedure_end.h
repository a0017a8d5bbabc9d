// Ends a procedure: decides which data are kept and which calibration is in use, and informs the
// person.
#pragma once

#include <exception>

#include "tools/calibrate/procedure_stages.h"

namespace ols::calibration {

// Ends a procedure with this outcome. Returns the exit status.
int finish(const Procedure& procedure, Outcome outcome, const StationFiles& station,
           StationLink& link, CalibrationStore& store, Person& person);
// Ends a procedure after an error: the old calibration stays in use, and the observations are kept.
// If the error came late, the folder of the observations may already have its final name.
[[noreturn]] void fail(const std::exception& error, const ProcedureSession& session,
                       CalibrationStore& store);

}  // namespace ols::calibration
