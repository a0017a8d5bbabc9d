// Browsers' questions about the land around the site. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console/entity_table.h"
#include "geometry/wgs84.h"

namespace ols::console {

// A question that is answered in another thread, because a skyline takes a second to compute and
// the land is read from a disk.
struct LandTask {
  enum class What { kAbout, kGround, kHeights, kSkyline, kProfile };
  What what = What::kAbout;
  // kGround: latitude, longitude [deg]. kHeights: west, south, east, north [deg]. kProfile:
  // latitude, longitude [deg] and height [m, above the WGS84 ellipsoid] of the other end; if the
  // height is missing, the other end is on the surface of the land.
  std::vector<double> numbers{};
  std::string station{};  // kSkyline, kProfile
  Geodetic camera{};      // camera centre of that station
};

// The place of a station's camera, from the fields of the station's status; nullopt: not known.
std::optional<Geodetic> camera_of(const Json& station);

// A question about the site: `path` "/api/land"; "/api/land/ground" with the `query`
// "?at=LATITUDE,LONGITUDE"; "/api/land/heights" with "?box=WEST,SOUTH,EAST,NORTH". nullopt for any
// other.
std::optional<LandTask> land_task(std::string_view path, std::string_view query);
// A question about a station: `what` is "skyline", or "profile" with the `query`
// "?to=LATITUDE,LONGITUDE[,HEIGHT]". nullopt for any other.
std::optional<LandTask> land_task(std::string_view what, std::string_view query,
                                  const std::string& station, const Geodetic& camera);

}  // namespace ols::console
