// The stars to magnitude 7: positions of the Hipparcos catalogue, made by
// dev/python/ols_star_table.py from the table in cedar-solve (Apache-2.0); see star_table.inc for
// its licence.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "calibration/observation.h"

namespace ols::calibration {

// ICRS, at the epoch below.
struct TableStar {
  std::int32_t hip = 0;         // number in the Hipparcos catalogue
  std::int32_t ra_1e5deg = 0;   // [1e-5 deg]
  std::int32_t dec_1e5deg = 0;  // [1e-5 deg]
  std::int32_t magnitude_tenths = 0;
};

// Proper motion up to this year is in the positions; the table has none after it. Of a star to
// magnitude 7 it is 0.04 arc seconds a year in the median, 0.3 in one of a hundred.
inline constexpr double kStarTableEpoch = 2024.0;

// By their numbers, ascending.
std::span<const TableStar> star_table();

// As it stands at the epoch: without proper motion and parallax.
Star star_of(const TableStar& star);

// "HIP 11767"; nothing for another text or a number that the table does not have.
std::optional<TableStar> table_star(std::string_view name);
std::string name_of(const TableStar& star);

}  // namespace ols::calibration
