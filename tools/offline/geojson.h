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

// The first ring is the outline, the others are holes. Each ends where it begins. Across the date
// line, longitudes continue beyond 180 degrees: neighbours differ by less than half a circle.
using GeoPolygon = std::vector<std::vector<GeoPosition>>;

struct GeoShapes {
  std::vector<GeoPoint> points;
  std::vector<GeoPolygon> polygons;
};

// Points and polygons, alone or in features and collections. Throws GeoJsonError for anything else,
// for positions out of range, and for rings that are not closed or go round a pole.
GeoShapes read_geojson(const std::string& path);

// A point with its height and the property "station".
nlohmann::json station_feature(const std::string& station, const GeoPosition& position);

// Whether the point is inside the outline and outside the holes, as plane figures of longitude and
// latitude. Good for areas of some kilometres away from the poles.
bool contains(const GeoPolygon& polygon, double longitude_deg, double latitude_deg);

// The points of an even east-north grid of this spacing inside any of the polygons, at the given
// height. Throws std::invalid_argument if there would be more than a million.
std::vector<Geodetic> fill(const std::vector<GeoPolygon>& polygons, double spacing_m,
                           double height_m);

}  // namespace ols::offline
