#include "console/maps/accuracy_file.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include "base/files/small_file.h"

namespace ols::console {
namespace {

constexpr std::size_t kMostHeights = 20, kMostCorners = 16;

[[noreturn]] void refuse(std::size_t feature, const std::string& what) {
  throw std::runtime_error("feature " + std::to_string(feature + 1) + ": " + what);
}

double number(const Json& properties, const char* key, std::size_t feature) {
  const auto found = properties.find(key);
  if (found == properties.end() || !found->is_number()) {
    refuse(feature, std::string(key) + " is missing or no number");
  }
  return found->get<double>();
}

// A ring's corners without the last, which is the first again.
Json corners(const Json& polygon, double sd_m, std::size_t feature) {
  const bool is_polygon = polygon.is_array() && !polygon.empty() && polygon[0].is_array();
  if (!is_polygon || polygon[0].size() < 4 || polygon[0].size() > kMostCorners) {
    refuse(feature, "is no polygon of a few corners");
  }
  Json cell = Json::array({sd_m});
  const Json& ring = polygon[0];
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const bool is_place = ring[i].is_array() && ring[i].size() >= 2 && ring[i][0].is_number() &&
                          ring[i][1].is_number();
    if (!is_place || std::abs(ring[i][0].get<double>()) > 180.0 ||
        std::abs(ring[i][1].get<double>()) > 90.0) {
      refuse(feature, "has a corner that is no place on Earth");
    }
    cell.push_back(ring[i][0]);
    cell.push_back(ring[i][1]);
  }
  return cell;
}

// A cell's polygons: two if it crosses the date line; none for a station.
Json polygons(const Json& feature, std::size_t index) {
  const auto geometry = feature.find("geometry");
  if (geometry == feature.end() || !geometry->is_object()) refuse(index, "has no geometry");
  const auto type = geometry->find("type"), coordinates = geometry->find("coordinates");
  if (type == geometry->end() || coordinates == geometry->end() || !coordinates->is_array()) {
    refuse(index, "has no coordinates");
  }
  if (*type == "Polygon") return Json::array({*coordinates});
  return *type == "MultiPolygon" ? *coordinates : Json::array();
}

}  // namespace

Json accuracy_cells(const std::string& geojson) {
  const Json file = Json::parse(geojson, nullptr, false);
  const bool is_collection = file.is_object() &&
                             file.value("type", Json()) == "FeatureCollection" &&
                             file.contains("features") && file.at("features").is_array();
  if (!is_collection) throw std::runtime_error("is no GeoJSON of ols-precision map");
  std::map<double, Json> heights;
  std::size_t cells = 0;
  for (std::size_t i = 0; i < file.at("features").size(); ++i) {
    const Json& feature = file.at("features")[i];
    if (!feature.is_object()) refuse(i, "is no feature");
    const Json parts = polygons(feature, i);
    if (parts.empty()) continue;
    const auto properties = feature.find("properties");
    if (properties == feature.end() || !properties->is_object()) refuse(i, "has no properties");
    const double sd_m =
        std::hypot(number(*properties, "horizontal_m", i), number(*properties, "up_sd_m", i));
    Json& at_height = heights[number(*properties, "above_stations_m", i)];
    for (const Json& part : parts)
      at_height.push_back(corners(part, std::round(sd_m * 1e4) / 1e4, i));
    cells += parts.size();
    if (cells > kMostAccuracyCells) throw std::runtime_error("has more than 100000 cells");
    if (heights.size() > kMostHeights) throw std::runtime_error("has more than 20 heights");
  }
  if (heights.empty()) throw std::runtime_error("has no cell with a deviation");
  Json list = Json::array();
  for (auto& [above_m, all] : heights) {
    list.push_back({{"above_m", above_m}, {"cells", std::move(all)}});
  }
  return {{"heights", std::move(list)}};
}

AccuracyFile::AccuracyFile(const std::string& path) {
  const Json cells = accuracy_cells(read_small_file(path, kMostAccuracyBytes));
  for (const Json& height : cells.at("heights")) heights_m_.push_back(height.at("above_m"));
  body_ = cells.dump();
}

}  // namespace ols::console
