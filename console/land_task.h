// Questions of browsers about the land around the site. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "console/entity_table.h"
#include "geometry/wgs84.h"

namespace ols::console {

// A question that is answered in another thread: a skyline takes a second to compute, and the land
// is read from a disk.
struct LandTask {
  enum class What { kAbout, kGround, kHeights, kSkyline, kProfile };
  What what = What::kAbout;
  // kGround: latitude, longitude [deg]. kHeights: west, south, east, north [deg]. kProfile:
  // latitude, longitude [deg], height [m, above the WGS84 ellipsoid]; without a height, the land's
  // there.
  std::vector<double> numbers{};
  std::string station{};  // kSkyline, kProfile
  Geodetic camera{};      // that station's camera centre
};

// Where a station's camera is, by the fields of its status; nullopt: the station does not know.
std::optional<Geodetic> camera_of(const Json& station);

// `path`: "/api/land", "/api/land/ground", "/api/land/heights"; `query`: "?at=LATITUDE,LONGITUDE",
// "?box=WEST,SOUTH,EAST,NORTH". nullopt for any other.
std::optional<LandTask> land_task(std::string_view path, std::string_view query);
// Of a station: `what` is "skyline" or "profile"; `query` of a profile is
// "?to=LATITUDE,LONGITUDE[,HEIGHT]". nullopt for any other.
std::optional<LandTask> land_task(std::string_view what, std::string_view query,
                                  const std::string& station, const Geodetic& camera);

}  // namespace ols::console
