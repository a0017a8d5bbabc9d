// What a bearing costs in the fusion, by the number of stations.
#pragma once

#include "dev/estimators/limits.h"

namespace ols::bench {

// A line for each number of stations, up to eight of them on a target: processor time.
void cost(Limits& limits);

}  // namespace ols::bench
