// An accuracy map of a planned site, from a file that `ols-precision map --geojson` has written:
// cells with the 1-sigma of a position, at one or more heights. Pure, except for reading the file.
#pragma once

#include <string>

#include "console/entity_table.h"

namespace ols::console {

inline constexpr std::size_t kMostAccuracyBytes = 16'000'000;
inline constexpr std::size_t kMostAccuracyCells = 100'000;

// Converts the text of such a file to {heights: [{above_m, cells: [[sd_m, longitude, latitude,
// ...], ...]}]}. Heights are above the stations, in ascending order. sd_m is the square root of the
// covariance's trace; the corners of the cell follow, in degrees. Throws std::runtime_error; the
// message says what is wrong.
Json accuracy_cells(const std::string& geojson);

class AccuracyFile {
 public:
  // Throws std::runtime_error or std::system_error; the message says what is damaged.
  explicit AccuracyFile(const std::string& path);

  const Json& heights_m() const { return heights_m_; }
  const std::string& body() const { return body_; }  // the JSON of accuracy_cells(), as text

 private:
  Json heights_m_ = Json::array();
  std::string body_;
};

}  // namespace ols::console
