// The end of a procedure: what is kept, which calibration is in use, and the messages to the
// person.
#pragma once

#include <exception>

#include "tools/calibrate/procedure_stages.h"

namespace ols::calibration {

// Ends a procedure after an outcome. Returns the exit status.
int finish(const Procedure& procedure, Outcome outcome, const StationFiles& station,
           StationLink& link, CalibrationStore& store, Person& person);
// Ends a procedure after an error: the old calibration stays in use, and the observations are kept.
// After a late failure they may already have their final name.
[[noreturn]] void fail(const std::exception& error, const ProcedureSession& session,
                       CalibrationStore& store);

}  // namespace ols::calibration
