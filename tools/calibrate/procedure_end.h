// The end of a procedure: what is kept, which calibration is in use, the messages to the person.
#pragma once

#include <exception>

#include "tools/calibrate/procedure_stages.h"

namespace ols::calibration {

// After an outcome; the exit status.
int finish(const Procedure& procedure, Outcome outcome, const StationFiles& station,
           StationLink& link, CalibrationStore& store, Person& person);
// After an error: the old calibration stands, and what was observed is kept. What failed late may
// have its final name already.
[[noreturn]] void fail(const std::exception& error, const ProcedureSession& session,
                       CalibrationStore& store);

}  // namespace ols::calibration
