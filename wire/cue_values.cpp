#include "wire/cue_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ols {
namespace {

constexpr double kLowest_m = -1000.0, kHighest_m = 100e3;
constexpr double kFastest_m_s = 3000.0, kMostSd_m = 1e6;
constexpr double kPole_deg = 89.9;

bool is_finite(const CueValues& cue) {
  const auto is_number = [](double value) { return std::isfinite(value); };
  return std::ranges::all_of(cue.velocity_enu_m_s, is_number) &&
         std::ranges::all_of(
             std::array{cue.latitude_deg, cue.longitude_deg, cue.height_m, cue.horizontal_sd_m,
                        cue.vertical_sd_m, cue.velocity_sd_m_s},
             is_number);
}

bool is_possible(const CueValues& cue) {
  const auto is_sd = [](double sd, double most) { return sd > 0.0 && sd <= most; };
  const auto& [east, north, up] = cue.velocity_enu_m_s;
  return std::abs(cue.latitude_deg) <= 90.0 && std::abs(cue.longitude_deg) <= 180.0 &&
         cue.height_m >= kLowest_m && cue.height_m <= kHighest_m &&
         is_sd(cue.horizontal_sd_m, kMostSd_m) && is_sd(cue.vertical_sd_m, kMostSd_m) &&
         is_sd(cue.velocity_sd_m_s, kFastest_m_s) && std::hypot(east, north, up) <= kFastest_m_s;
}

}  // namespace

CueFault fault_of(const CueValues& cue) {
  if (!is_finite(cue)) return CueFault::kNotFinite;
  if (!is_possible(cue)) return CueFault::kOutOfRange;
  return std::abs(cue.latitude_deg) > kPole_deg ? CueFault::kPole : CueFault::kNone;
}

std::optional<std::int64_t> target_named(const std::string& name) {
  std::int64_t id = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, id);
  if (error != std::errc{} || stop != end || id <= 0) return std::nullopt;
  return id;
}

}  // namespace ols
