#include "edge/camera/frame_clock.h"

#include <cmath>

namespace ols {
namespace {

// A frame cannot arrive before its stamp, nor this long after it: then the latched clock is not the
// one that stamps the frames, and only the arrivals tell.
constexpr double kOldest_s = 2.0;
constexpr double kSlack_s = 1e-3;

bool plausible(const MappedTime& stamp, double arrival_s) {
  return stamp.time_s < arrival_s + kSlack_s + 5.0 * stamp.sd_s &&
         stamp.time_s > arrival_s - kOldest_s;
}

}  // namespace

FrameTime FrameClock::stamp(std::optional<std::int64_t> device_ns, double arrival_s,
                            double exposure_s) {
  if (!device_ns) {
    return {.mid_exposure_s = arrival_s - config_.readout_s - 0.5 * exposure_s,
            .sd_s = config_.readout_sd_s,
            .source = StampSource::kArrival};
  }
  map_.add_arrival(*device_ns, arrival_s);
  const bool at_start = config_.stamp_at == StampAt::kExposureStart;
  const double to_middle_s = at_start ? 0.5 * exposure_s : -0.5 * exposure_s;
  const auto latched = map_.from_latches(*device_ns);
  if (latched && plausible(*latched, arrival_s))
    return {.mid_exposure_s = latched->time_s + to_middle_s, .sd_s = latched->sd_s};

  const double delay_s = config_.readout_s + (at_start ? exposure_s : 0.0);
  const MappedTime bounded = *map_.from_arrivals(*device_ns, delay_s);
  return {.mid_exposure_s = bounded.time_s + to_middle_s,
          .sd_s = std::hypot(bounded.sd_s, config_.readout_sd_s)};
}

}  // namespace ols
