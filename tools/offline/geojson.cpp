#include "tools/offline/geojson.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/angles.h"

namespace ols::offline {
namespace {

using nlohmann::json;

constexpr double kMostPoints = 1e6;

// The same meridian, at most half a circle from another one.
double near_to(double reference_deg, double longitude_deg) {
  return longitude_deg + 360.0 * std::round((reference_deg - longitude_deg) / 360.0);
}

// Each edge goes the short way, also over the date line.
void unroll(std::vector<GeoPosition>& ring, const GeoPosition& reference) {
  double before_deg = reference.longitude_deg;
  for (GeoPosition& p : ring) {
    p.longitude_deg = near_to(before_deg, p.longitude_deg);
    before_deg = p.longitude_deg;
  }
}

// Collects what a file holds; `where` names the place in it for errors.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  GeoShapes read() {
    std::ifstream file(path_, std::ios::binary);
    file.peek();  // a folder opens
    if (!file.is_open() || file.bad()) throw GeoJsonError(path_ + ": cannot be read");
    const json root = json::parse(file, nullptr, false);
    if (root.is_discarded()) throw GeoJsonError(path_ + ": is not JSON");
    add(root, "", "");
    return shapes_;
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& what) const {
    throw GeoJsonError(path_ + ": " + (where.empty() ? "" : where + ": ") + what);
  }

  const json& member(const json& object, const char* key, const std::string& where) const {
    if (!object.is_object() || !object.contains(key)) {
      fail(where, std::string(key) + " is missing");
    }
    return object.at(key);
  }

  const json& list(const json& object, const char* key, const std::string& where) const {
    const json& value = member(object, key, where);
    if (!value.is_array()) fail(where, std::string(key) + " must be a list");
    return value;
  }

  void add(const json& object, const std::string& name, const std::string& where) {
    const json& type_member = member(object, "type", where);
    const std::string type = type_member.is_string() ? type_member.get<std::string>() : "";
    if (type == "FeatureCollection") return add_all(list(object, "features", where), "features");
    if (type == "GeometryCollection") {
      return add_all(list(object, "geometries", where), where + " geometries");
    }
    if (type == "Feature") return add(member(object, "geometry", where), name_of(object), where);
    if (type == "Point") return add_point(list(object, "coordinates", where), name, where);
    if (type == "MultiPoint") {
      for (const json& p : list(object, "coordinates", where)) add_point(p, name, where);
      return;
    }
    if (type == "Polygon") return add_polygon(list(object, "coordinates", where), where);
    if (type == "MultiPolygon") {
      for (const json& p : list(object, "coordinates", where)) add_polygon(p, where);
      return;
    }
    fail(where, "type '" + type + "' is neither point nor polygon");
  }

  void add_all(const json& members, const std::string& where) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      add(members[i], "", where + "[" + std::to_string(i) + "]");
    }
  }

  static std::string name_of(const json& feature) {
    if (!feature.contains("properties") || !feature.at("properties").is_object()) return "";
    for (const char* key : {"station", "name"}) {
      const auto found = feature.at("properties").find(key);
      if (found != feature.at("properties").end() && found->is_string()) return *found;
    }
    return "";
  }

  GeoPosition position(const json& value, const std::string& where) const {
    const bool numbers = value.is_array() && value.size() >= 2 &&
                         std::ranges::all_of(value, [](const json& v) { return v.is_number(); });
    if (!numbers) fail(where, "a position must be [longitude, latitude] or with a height");
    GeoPosition p{value[0].get<double>(), value[1].get<double>(), std::nullopt};
    if (value.size() > 2) p.height_m = value[2].get<double>();
    if (!(std::abs(p.longitude_deg) <= 180.0)) fail(where, "longitude is outside -180 .. 180");
    if (!(std::abs(p.latitude_deg) <= 90.0)) fail(where, "latitude is outside -90 .. 90");
    return p;
  }

  void add_point(const json& value, const std::string& name, const std::string& where) {
    shapes_.points.push_back({name, position(value, where)});
  }

  void add_polygon(const json& rings, const std::string& where) {
    GeoPolygon polygon;
    if (!rings.is_array() || rings.empty()) fail(where, "a polygon must have a ring");
    for (const json& ring : rings) {
      std::vector<GeoPosition> points;
      if (!ring.is_array()) fail(where, "a ring must be a list");
      for (const json& p : ring) points.push_back(position(p, where));
      const bool closed = points.size() >= 4 &&
                          points.front().longitude_deg == points.back().longitude_deg &&
                          points.front().latitude_deg == points.back().latitude_deg;
      if (!closed) fail(where, "a ring must have four positions or more and end where it begins");
      unroll(points, polygon.empty() ? points.front() : polygon.front().front());
      if (points.front().longitude_deg != points.back().longitude_deg) {
        fail(where, "a ring must not go round a pole");
      }
      polygon.push_back(std::move(points));
    }
    shapes_.polygons.push_back(polygon);
  }

  std::string path_;
  GeoShapes shapes_;
};

}  // namespace

GeoShapes read_geojson(const std::string& path) { return Reader(path).read(); }

nlohmann::json station_feature(const std::string& station, const GeoPosition& p) {
  return {{"type", "Feature"},
          {"geometry",
           {{"type", "Point"},
            {"coordinates", {p.longitude_deg, p.latitude_deg, p.height_m.value_or(0.0)}}}},
          {"properties", {{"station", station}}}};
}

bool contains(const GeoPolygon& polygon, double longitude_deg, double latitude_deg) {
  const auto [west, east] = std::ranges::minmax(polygon.front(), {}, &GeoPosition::longitude_deg);
  longitude_deg = near_to((west.longitude_deg + east.longitude_deg) / 2.0, longitude_deg);
  bool inside = false;  // changes at every edge to the east
  for (const auto& ring : polygon) {
    for (std::size_t i = 1; i < ring.size(); ++i) {
      const GeoPosition &a = ring[i - 1], &b = ring[i];
      if ((a.latitude_deg > latitude_deg) == (b.latitude_deg > latitude_deg)) continue;
      const double share = (latitude_deg - a.latitude_deg) / (b.latitude_deg - a.latitude_deg);
      const double edge_deg = a.longitude_deg + share * (b.longitude_deg - a.longitude_deg);
      if (longitude_deg < edge_deg) inside = !inside;
    }
  }
  return inside;
}

namespace {

// Metres east a radian of longitude, and north a radian of latitude.
Eigen::Vector2d metres_a_radian(const Geodetic& middle) {
  const LocalFrame frame(middle);
  constexpr double kStep_rad = 1e-5;
  Geodetic north = middle, east = middle;
  north.latitude_rad += kStep_rad;
  east.longitude_rad += kStep_rad;
  return Eigen::Vector2d(frame.to_enu(ecef_from_geodetic(east)).x(),
                         frame.to_enu(ecef_from_geodetic(north)).y()) /
         kStep_rad;
}

void fill_one(const GeoPolygon& polygon, double spacing_m, double height_m,
              std::vector<Geodetic>& points) {
  const auto& outline = polygon.front();
  const auto [west, east] = std::ranges::minmax(outline, {}, &GeoPosition::longitude_deg);
  const auto [south, north] = std::ranges::minmax(outline, {}, &GeoPosition::latitude_deg);
  const Geodetic middle{radians(0.5 * (south.latitude_deg + north.latitude_deg)),
                        radians(0.5 * (west.longitude_deg + east.longitude_deg)), height_m};
  const Eigen::Vector2d step_rad = spacing_m * metres_a_radian(middle).cwiseInverse();
  const double rows = radians(north.latitude_deg - south.latitude_deg) / step_rad.y();
  const double columns = radians(east.longitude_deg - west.longitude_deg) / step_rad.x();
  if (rows * columns > kMostPoints) {
    throw std::invalid_argument("a spacing of " + std::to_string(spacing_m) +
                                " m gives more than a million points");
  }
  for (int row = 0; row <= static_cast<int>(rows); ++row) {
    for (int column = 0; column <= static_cast<int>(columns); ++column) {
      const double latitude_rad =
          middle.latitude_rad + (row - 0.5 * std::floor(rows)) * step_rad.y();
      const double longitude_rad =
          middle.longitude_rad + (column - 0.5 * std::floor(columns)) * step_rad.x();
      if (!contains(polygon, degrees(longitude_rad), degrees(latitude_rad))) continue;
      points.push_back({latitude_rad, wrap_pi(longitude_rad), height_m});
    }
  }
}

}  // namespace

std::vector<Geodetic> fill(const std::vector<GeoPolygon>& polygons, double spacing_m,
                           double height_m) {
  std::vector<Geodetic> points;
  for (const GeoPolygon& polygon : polygons) fill_one(polygon, spacing_m, height_m, points);
  return points;
}

}  // namespace ols::offline
