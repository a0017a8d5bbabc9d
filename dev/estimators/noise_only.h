// Flights before stations that have no errors but noise, and state nothing else: whatever the
// filter allows for costs it nothing there.
#pragma once

#include "dev/estimators/limits.h"

namespace ols::bench {

// A manoeuvring drone for 12 s, 2, 3, 4, 12 and 100 stations on a circle of 250 m at 15 Hz: the
// recorded filter and its smoother against least squares at the same instants. Beside it, without a
// limit, one that hardly manoeuvres, at 30 Hz. Deterministic by the number of runs.
void noise_only(int runs, Limits& limits);

}  // namespace ols::bench
