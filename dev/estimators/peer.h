// Exports simulated bearings for another program's filter, with the results of our filter. All
// values are in metres and radians, in east, north, up at the site's middle. The files:
//   stations.csv  station,east_m,north_m,up_m
//   bearings.csv  run,time_s,station,azimuth_rad,elevation_rad   in order of time in each run
//   fixes.csv     run,time_s,true_{east,north,up}_m,{east,north,up}_m   after each bearing; empty
//                 before there is a position
//   pinned.csv    noise_rad,disturbance   the true values, which both filters know
//                 cpu_us                  processor time of our filter per bearing
#pragma once

#include <string>

namespace ols::bench {

// Throws std::runtime_error if the folder cannot be written.
void write_peer_runs(const std::string& folder, int runs);

}  // namespace ols::bench
