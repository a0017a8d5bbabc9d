// The station's UTC as the kernel has it, for a camera whose clock is TAI by PTP.
#pragma once

#include <optional>

#include "edge/camera/frame_clock.h"

namespace ols::camera {

// Nothing while the kernel says that its clock is not synchronised. `tai_minus_utc_s` counts where
// the kernel does not know the leap seconds; `ptp_sd_s` is the master's own.
std::optional<TaiReference> read_tai_reference(int tai_minus_utc_s, double ptp_sd_s);

}  // namespace ols::camera
