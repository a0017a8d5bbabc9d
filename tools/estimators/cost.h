// What a bearing costs in the fusion, by the number of stations.
#pragma once

namespace ols::bench {

// Prints a line for each number of stations; up to eight of them on a target.
void print_cost();

}  // namespace ols::bench
