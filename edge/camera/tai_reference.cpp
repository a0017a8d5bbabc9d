#include "edge/camera/tai_reference.h"

#include <sys/timex.h>

#include <cmath>

#include "base/process/clocks.h"

namespace ols::camera {

std::optional<TaiReference> read_tai_reference(int tai_minus_utc_s, double ptp_sd_s) {
  timex kernel{};  // no modes: only read
  const int state = ntp_adjtime(&kernel);
  if (state < 0 || state == TIME_ERROR) return std::nullopt;
  const int leap_s = kernel.tai > 0 ? kernel.tai : tai_minus_utc_s;
  const std::int64_t before_ns = clock_monotonic_ns();
  const std::int64_t utc_ns = clock_utc_ns();
  const std::int64_t after_ns = clock_monotonic_ns();
  const std::int64_t middle_ns = before_ns + (after_ns - before_ns) / 2;
  const double utc_sd_s = 1e-6 * static_cast<double>(kernel.esterror);
  const double read_s = 1e-9 * static_cast<double>(after_ns - before_ns);
  return TaiReference{
      .monotonic_minus_tai_ns = middle_ns - utc_ns - std::int64_t{leap_s} * 1'000'000'000,
      .sd_s = std::hypot(utc_sd_s, read_s, ptp_sd_s)};
}

}  // namespace ols::camera
