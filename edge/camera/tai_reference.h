// Reads the station's UTC from the kernel, for a camera whose clock follows TAI through PTP.
#pragma once

#include <optional>

#include "edge/camera/frame_clock.h"

namespace ols::camera {

// Returns nullopt while the kernel reports that its clock is not synchronised. `tai_minus_utc_s` is
// used if the kernel does not know the leap seconds; `ptp_sd_s` is the 1-sigma of the PTP master's
// time.
std::optional<TaiReference> read_tai_reference(int tai_minus_utc_s, double ptp_sd_s);

}  // namespace ols::camera
