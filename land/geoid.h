// The height of the geoid (sea level) above the WGS84 ellipsoid, from a grid file that PROJ reads.
// Without a geoid, no program writes a height above sea level.
#pragma once

#include <memory>
#include <string>

namespace ols::land {

class Geoid {
 public:
  // `grid`: a name in PROJ's folders (egm96_15.gtx of Debian's proj-data) or a path. Throws
  // std::invalid_argument.
  explicit Geoid(const std::string& grid);
  ~Geoid();
  Geoid(const Geoid&) = delete;
  Geoid& operator=(const Geoid&) = delete;

  // The height of the geoid above the ellipsoid [m]; not finite outside the grid.
  double height_m(double latitude_deg, double longitude_deg) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace ols::land
