#include "calibration/star_table.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr TableStar kStars[] = {
#include "calibration/star_table.inc"
};

constexpr std::string_view kPrefix = "HIP ";

}  // namespace

std::span<const TableStar> star_table() { return kStars; }

Star star_of(const TableStar& star) {
  constexpr double kUnit_deg = 1e-5;
  Star result;
  result.ra_rad = radians(kUnit_deg * star.ra_1e5deg);
  result.dec_rad = radians(kUnit_deg * star.dec_1e5deg);
  return result;
}

std::optional<TableStar> table_star(std::string_view name) {
  if (!name.starts_with(kPrefix)) return std::nullopt;
  name.remove_prefix(kPrefix.size());
  std::int32_t hip = 0;
  const auto [rest, error] = std::from_chars(name.data(), name.data() + name.size(), hip);
  if (error != std::errc() || rest != name.data() + name.size()) return std::nullopt;
  const auto found = std::ranges::lower_bound(kStars, hip, {}, &TableStar::hip);
  if (found == std::end(kStars) || found->hip != hip) return std::nullopt;
  return *found;
}

std::string name_of(const TableStar& star) {
  return std::string(kPrefix) + std::to_string(star.hip);
}

}  // namespace ols::calibration
