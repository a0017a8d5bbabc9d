// GeoJSON (RFC 7946): reads places and areas, writes features. Positions are longitude, latitude in
// degrees and, where given, metres above the WGS84 ellipsoid.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/wgs84.h"

namespace ols::offline {

// what() is one line: "FILE: features[3]: what is wrong".
class GeoJsonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct GeoPosition {
  double longitude_deg = 0.0;
  double latitude_deg = 0.0;
  std::optional<double> height_m;
};

struct GeoPoint {
  std::string name;  // property "station" or "name"; empty: none
  GeoPosition position;
};

// The first ring is the outline, the others are holes. Each ring ends at its first point. Across
// the date line, longitudes continue beyond 180 degrees: consecutive longitudes never differ by
// more than half a circle.
using GeoPolygon = std::vector<std::vector<GeoPosition>>;

struct GeoShapes {
  std::vector<GeoPoint> points;
  std::vector<GeoPolygon> polygons;
};

// Reads points and polygons, alone or in features and collections. Throws GeoJsonError for any
// other geometry, for positions out of range, and for rings that are not closed or enclose a pole.
GeoShapes read_geojson(const std::string& path);

// A feature of a point with its height and the property "station".
nlohmann::json station_feature(const std::string& station, const GeoPosition& position);

// Whether the point is inside the outline and outside the holes, with longitude and latitude as
// plane coordinates. Suitable for areas of some kilometres that are not near a pole.
bool contains(const GeoPolygon& polygon, double longitude_deg, double latitude_deg);

// The points of a regular east-north grid with this spacing that are inside any of the polygons, at
// this height. Throws std::invalid_argument if there would be more than a million points.
std::vector<Geodetic> fill(const std::vector<GeoPolygon>& polygons, double spacing_m,
                           double height_m);

}  // namespace ols::offline
