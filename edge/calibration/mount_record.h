// The file in which `ols-calibrate mount` keeps its last result for ols-doctor. Its lines are for a
// person: when it was measured, then one line for each axis.
#pragma once

namespace ols::station {

// In the station's folder of calibrations.
inline constexpr const char* kMountRecord = "mount.txt";

}  // namespace ols::station
