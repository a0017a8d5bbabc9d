// ols-calibrate rectify: the paper's rectification (section 4.2) as a guided procedure.
#pragma once

#include "tools/calibrate/procedure_stages.h"

namespace ols::calibration {

// One stage per target of options.targets. Throws ConfigError naming file and key.
Procedure make_rectification(const ProcedureOptions& options, const StationFiles& station,
                             StationLink& link, ProcedureSession& session);

}  // namespace ols::calibration
