#include "edge/clock/clock_reading.h"

namespace ols::clock {
namespace {

bool has_traces_of_service(const KernelClock& kernel) {
  return kernel.synchronised || kernel.loop || kernel.frequency != 0.0 ||
         kernel.estimated_error_s || kernel.max_error_s;
}

}  // namespace

ClockReading make_clock_reading(const KernelClock& kernel,
                                const std::optional<ChronyTracking>& chrony, bool service_seen) {
  ClockReading reading;
  reading.leap_s = kernel.leap_s;
  if (kernel.tai_minus_utc_s != 0) reading.tai_minus_utc_s = kernel.tai_minus_utc_s;
  if (chrony) {
    reading.service = true;
    reading.synchronised = chrony->synchronised;
    if (chrony->synchronised) {
      reading.estimated_error_s = chrony->error_s();
      reading.offset_s = chrony->offset_s;
      reading.measured_utc_s = chrony->measured_utc_s;
    }
    reading.source = "chrony: " + (chrony->reference.empty() ? "no source" : chrony->reference);
    if (chrony->leap_s != 0) reading.leap_s = chrony->leap_s;
    return reading;
  }
  reading.service = service_seen || has_traces_of_service(kernel);
  reading.synchronised = kernel.synchronised;
  if (reading.service) reading.source = "kernel";
  // systemd-timesyncd leaves the estimate at 0, which means unknown.
  if (kernel.synchronised && kernel.estimated_error_s.value_or(0.0) > 0.0) {
    reading.estimated_error_s = kernel.estimated_error_s;
  }
  return reading;
}

}  // namespace ols::clock
