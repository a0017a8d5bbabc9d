// Meteors: short recordings of very fast objects, which no drone's recording stands for.
#pragma once

#include "dev/estimators/limits.h"

namespace ols::bench {

// 0.3 to 5 s of 10 to 70 km/s at 80 to 200 km, 2 to 6 cameras that state nothing but their noise:
// the recorded filter and its smoother against least squares at the same instants. Deterministic by
// the number of runs.
void meteors(int runs, Limits& limits);

}  // namespace ols::bench
