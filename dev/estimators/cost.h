// What a bearing costs in the fusion, by the number of stations.
#pragma once

#include "dev/estimators/limits.h"

namespace ols::bench {

// A line for each site: processor time. Up to 1000 stations, eight on a target; and up to 100 that
// are all on the same target or targets.
void cost(Limits& limits);

}  // namespace ols::bench
