// The stars down to magnitude 7, with positions of the Hipparcos catalogue.
// dev/python/ols_star_table.py makes the table from that of cedar-solve (Apache-2.0); see
// star_table.inc for its licence.
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

// The positions include proper motion up to this year only. Proper motion is 0.04 arc seconds a
// year in the median, and above 0.3 for one star in a hundred.
inline constexpr double kStarTableEpoch = 2024.0;

// The table, sorted by Hipparcos number.
std::span<const TableStar> star_table();

// The star at the epoch, without proper motion and parallax.
Star star_of(const TableStar& star);

// Finds a star by its name, such as "HIP 11767"; nullopt for another text, or for a number that is
// not in the table.
std::optional<TableStar> table_star(std::string_view name);
std::string name_of(const TableStar& star);

}  // namespace ols::calibration
