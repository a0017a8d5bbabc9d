#include "edge/camera/frame_clock.h"

#include <cmath>

namespace ols::camera {
namespace {

// A frame cannot arrive before its stamp, nor this long after it: otherwise the latched clock is
// not the one that stamps the frames, and only the arrivals are used. The earliest of many arrivals
// counts, because a station that got no processor time for seconds reads what the kernel has
// buffered.
constexpr double kOldest_s = 5.0;
constexpr double kSlack_s = 1e-3;

// PTP and latches must agree within this many standard deviations, plus the asymmetry of the
// network delay.
constexpr double kAgree = 5.0;
constexpr double kAgree_s = 1e-3;

bool plausible(const MappedTime& stamp, double earliest_s) {
  return stamp.time_s < earliest_s + kSlack_s + 5.0 * stamp.sd_s &&
         stamp.time_s > earliest_s - kOldest_s;
}

}  // namespace

// From the start or the end of an exposure to its middle.
FrameTime FrameClock::from_mark(const MappedTime& mark, bool at_start, const ExposureLog& exposures,
                                StampSource source) const {
  const double start_s = at_start ? mark.time_s : mark.time_s - exposures.newest_s();
  const ExposureUsed used = exposures.at(start_s);
  const double half_s = 0.5 * used.exposure_s;
  return {.mid_exposure_s = mark.time_s + (at_start ? half_s : -half_s),
          .sd_s = std::hypot(mark.sd_s, 0.5 * used.sd_s),
          .source = source};
}

MappedTime FrameClock::with_tai(const MappedTime& latched, std::int64_t device_ns) {
  tai_disagreement_s_.reset();
  if (!tai_) return latched;
  const MappedTime by_tai{
      .time_s = 1e-9 * static_cast<double>(device_ns + tai_->monotonic_minus_tai_ns),
      .sd_s = tai_->sd_s};
  const double difference_s = by_tai.time_s - latched.time_s;
  if (std::abs(difference_s) > kAgree * std::hypot(by_tai.sd_s, latched.sd_s) + kAgree_s) {
    tai_disagreement_s_ = difference_s;
    return latched;
  }
  return by_tai.sd_s < latched.sd_s ? by_tai : latched;
}

FrameTime FrameClock::stamp(std::optional<std::int64_t> device_ns, double arrival_s,
                            const ExposureLog& exposures) {
  if (!device_ns) {
    const MappedTime end{.time_s = arrival_s - config_.readout_s, .sd_s = config_.readout_sd_s};
    return from_mark(end, false, exposures, StampSource::kArrival);
  }
  map_.add_arrival(*device_ns, arrival_s);
  const bool at_start = config_.stamp_at == StampAt::kExposureStart;
  const auto latched = map_.from_latches(*device_ns);
  if (latched && plausible(*latched, map_.from_arrivals(*device_ns, 0.0)->time_s))
    return from_mark(with_tai(*latched, *device_ns), at_start, exposures, StampSource::kCamera);

  const double delay_s = config_.readout_s + (at_start ? exposures.newest_s() : 0.0);
  MappedTime bounded = *map_.from_arrivals(*device_ns, delay_s);
  bounded.sd_s = std::hypot(bounded.sd_s, config_.readout_sd_s);
  return from_mark(bounded, at_start, exposures, StampSource::kCamera);
}

}  // namespace ols::camera
