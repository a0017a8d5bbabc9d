#include "tools/land/scenery_coverings.h"

#include <filesystem>

#include "geometry/angles.h"
#include "geometry/wgs84.h"
#include "tools/land/scenery_file.h"

namespace ols::land {
namespace {

Covering square_of(const SceneryRow& row) {
  const LocalFrame frame({radians(row.latitude_deg), radians(row.longitude_deg), row.height_m});
  const double half_m = 0.5 * kSceneryWide_rad * row.range_m;
  const double middle_rad = frame.origin().longitude_rad;
  Covering covering{CoveringKind::kScenery, {{}}, row.height_m, row.height_sd_m};
  for (const auto& [east, north] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Geodetic corner = geodetic_from_ecef(frame.to_ecef({east * half_m, north * half_m, 0.0}));
    // Continues beyond 180 degrees.
    covering.rings.front().emplace_back(middle_rad + wrap_pi(corner.longitude_rad - middle_rad),
                                        corner.latitude_rad);
  }
  return covering;
}

}  // namespace

ReadCoverings read_scenery_coverings(const std::string& path, const Bounds& bounds) {
  ReadCoverings read;
  std::size_t elsewhere = 0;
  for (const SceneryRow& row : read_scenery(path)) {
    const double longitude_deg = row.longitude_deg + turns_deg(bounds, row.longitude_deg);
    if (longitude_deg < bounds.west_deg || longitude_deg > bounds.east_deg ||
        row.latitude_deg < bounds.south_deg || row.latitude_deg > bounds.north_deg) {
      ++elsewhere;
      continue;
    }
    read.coverings.push_back(square_of(row));
  }
  read.notes.push_back(std::filesystem::path(path).filename().string() + ": " +
                       std::to_string(read.coverings.size()) + " points of measured scenery, " +
                       std::to_string(elsewhere) + " elsewhere");
  return read;
}

}  // namespace ols::land
