#include "edge/clock/chrony_tracking.h"

#include <array>
#include <charconv>
#include <cmath>

namespace ols::clock {
namespace {

// Reference id, name, stratum, reference time, correction, last offset, RMS offset, frequency,
// residual frequency, skew, root delay, root dispersion, update interval, leap status.
constexpr std::size_t kFields = 14;
// chronyd's "local" mode: it serves its own free-running clock, and calls itself synchronised.
constexpr std::string_view kLocalReference = "7F7F0101";
enum Field {
  kId = 0,
  kName = 1,
  kRefTime = 3,
  kCorrection = 4,
  kDelay = 10,
  kDispersion = 11,
  kLeap = 13
};

std::optional<std::array<std::string_view, kFields>> split(std::string_view line) {
  std::array<std::string_view, kFields> fields;
  for (std::size_t i = 0; i < kFields; ++i) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == kFields)) return std::nullopt;
    fields[i] = line.substr(0, comma);
    if (i + 1 < kFields) line.remove_prefix(comma + 1);
  }
  return fields;
}

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

double ChronyTracking::error_s() const {
  const double bound_s = std::abs(offset_s) + root_dispersion_s + 0.5 * root_delay_s;
  return bound_s / std::sqrt(3.0);
}

std::optional<ChronyTracking> parse_chrony_tracking(std::string_view line) {
  line = line.substr(0, line.find('\n'));
  const auto fields = split(line);
  if (!fields) return std::nullopt;
  const auto measured = number((*fields)[kRefTime]), correction = number((*fields)[kCorrection]);
  const auto delay = number((*fields)[kDelay]), dispersion = number((*fields)[kDispersion]);
  if (!measured || !correction || !delay || !dispersion) return std::nullopt;
  if (*delay < 0.0 || *dispersion < 0.0) return std::nullopt;
  const std::string_view leap = (*fields)[kLeap];
  ChronyTracking tracking;
  tracking.reference = (*fields)[kName];
  const bool local = (*fields)[kId] == kLocalReference;
  if (local) tracking.reference = "local clock";
  tracking.synchronised =
      !local && (leap == "Normal" || leap == "Insert second" || leap == "Delete second");
  tracking.measured_utc_s = *measured;
  // chronyc prints what must be added to the clock: positive when the clock is slow.
  tracking.offset_s = -*correction;
  tracking.root_delay_s = *delay;
  tracking.root_dispersion_s = *dispersion;
  tracking.leap_s = leap == "Insert second" ? 1 : leap == "Delete second" ? -1 : 0;
  return tracking;
}

}  // namespace ols::clock
