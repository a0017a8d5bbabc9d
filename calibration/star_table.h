// The stars down to magnitude 7: positions of the Hipparcos catalogue. dev/python/ols_star_table.py
// makes the table from that of cedar-solve (Apache-2.0); see star_table.inc for its licence.
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

// The positions include proper motion up to this year, and no later motion. The motion is 0.04 arc
// seconds a year in the median, and above 0.3 for one star in a hundred.
inline constexpr double kStarTableEpoch = 2024.0;

// Ascending by number.
std::span<const TableStar> star_table();

// At the epoch, without proper motion and parallax.
Star star_of(const TableStar& star);

// "HIP 11767"; nullopt for another text, or a number that the table does not have.
std::optional<TableStar> table_star(std::string_view name);
std::string name_of(const TableStar& star);

}  // namespace ols::calibration
