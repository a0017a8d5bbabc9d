// The stars down to magnitude 7, with positions of the Hipparcos catalogue.
// dev/python/ols_star_table.py makes the table from the table of cedar-solve (Apache-2.0);
// star_table.inc contains its licence.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "calibration/observation.h"

namespace ols::calibration {

// A star of the table: ICRS, at the epoch kStarTableEpoch.
struct TableStar {
  std::int32_t hip = 0;         // number in the Hipparcos catalogue
  std::int32_t ra_1e5deg = 0;   // [1e-5 deg]
  std::int32_t dec_1e5deg = 0;  // [1e-5 deg]
  std::int32_t magnitude_tenths = 0;
};

// The year up to which the positions include proper motion. The median of the proper motions is
// 0.04 arc seconds per year; one star in a hundred has more than 0.3.
inline constexpr double kStarTableEpoch = 2024.0;

// The table, sorted by Hipparcos number.
std::span<const TableStar> star_table();

// The star's position at the epoch; proper motion and parallax are set to 0.
Star star_of(const TableStar& star);

// Finds a star by its name, such as "HIP 11767"; nullopt for another text, or for a number that is
// not in the table.
std::optional<TableStar> table_star(std::string_view name);
std::string name_of(const TableStar& star);

}  // namespace ols::calibration
