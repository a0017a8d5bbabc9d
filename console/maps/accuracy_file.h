// A map of the accuracy that `ols-precision map --geojson` has computed for planned sites: cells
// with their deviations, at one or more heights. Pure, except for reading its file.
#pragma once

#include <string>

#include "console/entity_table.h"

namespace ols::console {

inline constexpr std::size_t kMostAccuracyBytes = 16'000'000;
inline constexpr std::size_t kMostAccuracyCells = 100'000;

// From the text of such a file: {heights: [{above_m, cells: [[sd_m, longitude, latitude, ...],
// ...]}]}: the heights above the stations in ascending order, the corners of each cell in degrees,
// and the root of the covariance's trace. Throws std::runtime_error with the error.
Json accuracy_cells(const std::string& geojson);

class AccuracyFile {
 public:
  // Throws std::runtime_error or std::system_error with the damage.
  explicit AccuracyFile(const std::string& path);

  const Json& heights_m() const { return heights_m_; }
  const std::string& body() const { return body_; }  // JSON, as accuracy_cells()

 private:
  Json heights_m_ = Json::array();
  std::string body_;
};

}  // namespace ols::console
