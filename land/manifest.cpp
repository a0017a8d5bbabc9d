#include "land/manifest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::land {
namespace {

using Json = nlohmann::json;

constexpr const char* kFormat = "ols-land";
constexpr double kHighest_m = 1000.0;  // of buildings and trees
constexpr double kLowestLand_m = -500.0, kHighestLand_m = 10'000.0;
constexpr int kMostRows = 1'000'000;

struct KindName {
  CoveringKind kind;
  const char* name;
};
constexpr std::array kKinds{KindName{CoveringKind::kBuilding, "building"},
                            KindName{CoveringKind::kWood, "wood"},
                            KindName{CoveringKind::kScenery, "scenery"}};

[[noreturn]] void fail(const std::string& key, const std::string& what) {
  throw std::invalid_argument(key + ": " + what);
}

const Json& member(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end()) fail(key, "is missing");
  return *found;
}

const Json& list(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_array()) fail(key, "is not a list");
  return value;
}

double number(const Json& object, const char* key, double least, double greatest) {
  const Json& value = member(object, key);
  if (!value.is_number()) fail(key, "is not a number");
  const double number = value.get<double>();
  if (!(number >= least && number <= greatest)) fail(key, value.dump() + " is out of range");
  return number;
}

std::string text(const Json& object, const char* key) {
  const Json& value = member(object, key);
  if (!value.is_string()) fail(key, "is not a text");
  return value.get<std::string>();
}

Json parse(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw std::invalid_argument(std::string("is no JSON: ") + error.what());
  }
}

GridFile grid_from(const Json& json) {
  GridFile grid{text(json, "file"),
                text(json, "sha256"),
                number(json, "north_deg", -90.0, 90.0),
                number(json, "west_deg", -360.0, 360.0),
                number(json, "step_latitude_deg", 1e-8, 10.0),
                number(json, "step_longitude_deg", 1e-8, 10.0),
                static_cast<int>(number(json, "rows", 2, kMostRows)),
                static_cast<int>(number(json, "columns", 2, kMostRows)),
                number(json, "sd_m", 0.0, 1000.0)};
  if (grid.file.empty() || grid.file.find('/') != std::string::npos || grid.file[0] == '.') {
    fail("file", "\"" + grid.file + "\" is not the name of a file of this folder");
  }
  return grid;
}

Json to_json(const GridFile& grid) {
  return {{"file", grid.file},
          {"sha256", grid.sha256},
          {"north_deg", grid.north_deg},
          {"west_deg", grid.west_deg},
          {"step_latitude_deg", grid.step_latitude_deg},
          {"step_longitude_deg", grid.step_longitude_deg},
          {"rows", grid.rows},
          {"columns", grid.columns},
          {"sd_m", grid.sd_m}};
}

Eigen::Vector2d corner_from(const Json& corner) {
  if (!corner.is_array() || corner.size() != 2 || !corner[0].is_number() ||
      !corner[1].is_number()) {
    fail("rings", "a corner is not a longitude and a latitude");
  }
  const Eigen::Vector2d degrees(corner[0].get<double>(), corner[1].get<double>());
  if (!(std::abs(degrees.x()) <= 180.0 && std::abs(degrees.y()) <= 90.0)) {
    fail("rings", corner.dump() + " is out of range");
  }
  return {radians(degrees.x()), radians(degrees.y())};
}

Covering covering_from(const Json& json) {
  Covering covering;
  const std::string kind = text(json, "kind");
  const auto named = std::ranges::find(kKinds, kind, &KindName::name);
  if (named == kKinds.end()) fail("kind", "\"" + kind + "\" is not known");
  covering.kind = named->kind;
  const bool on_ground = covering.kind != CoveringKind::kScenery;
  covering.height_m = number(json, "height_m", on_ground ? 0.0 : kLowestLand_m,
                             on_ground ? kHighest_m : kHighestLand_m);
  covering.sd_m = number(json, "sd_m", 0.0, kHighest_m);
  for (const Json& ring : list(json, "rings")) {
    if (!ring.is_array() || ring.size() < 3) fail("rings", "a ring has fewer than three corners");
    auto& corners = covering.rings.emplace_back();
    for (const Json& corner : ring) corners.push_back(corner_from(corner));
  }
  return covering;
}

}  // namespace

std::string to_text(const Manifest& manifest) {
  Json sources = Json::array(), grids = Json::array();
  for (const Source& source : manifest.sources) {
    sources.push_back({{"file", source.file},
                       {"kind", source.kind},
                       {"licence", source.licence},
                       {"heights", source.heights},
                       {"sd_m", source.sd_m}});
  }
  for (const GridFile& grid : manifest.grids) grids.push_back(to_json(grid));
  const Json json{{"format", kFormat},
                  {"version", kFormatVersion},
                  {"latitude_deg", manifest.latitude_deg},
                  {"longitude_deg", manifest.longitude_deg},
                  {"radius_km", manifest.radius_km},
                  {"sources", sources},
                  {"grids", grids},
                  {"coverings_sha256", manifest.coverings_sha256},
                  {"notes", manifest.notes}};
  // Names of files may be in any encoding.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Manifest parse_manifest(std::string_view manifest_text) {
  const Json json = parse(manifest_text);
  if (text(json, "format") != kFormat) fail("format", "is not that of ols-land import");
  if (number(json, "version", 0, 1e6) != kFormatVersion) {
    fail("version", member(json, "version").dump() + " is not known here: import again");
  }
  Manifest manifest{.latitude_deg = number(json, "latitude_deg", -90.0, 90.0),
                    .longitude_deg = number(json, "longitude_deg", -180.0, 180.0),
                    .radius_km = number(json, "radius_km", 0.0, 1000.0),
                    .coverings_sha256 = text(json, "coverings_sha256")};
  for (const Json& source : list(json, "sources")) {
    manifest.sources.push_back({text(source, "file"), text(source, "kind"), text(source, "licence"),
                                text(source, "heights"), number(source, "sd_m", 0.0, 1000.0)});
  }
  for (const Json& grid : list(json, "grids")) manifest.grids.push_back(grid_from(grid));
  for (const Json& note : list(json, "notes")) {
    if (!note.is_string()) fail("notes", "one is not a text");
    manifest.notes.push_back(note.get<std::string>());
  }
  return manifest;
}

std::string to_text(const std::vector<Covering>& coverings) {
  Json json = Json::array();
  for (const Covering& covering : coverings) {
    Json rings = Json::array();
    for (const auto& ring : covering.rings) {
      Json& corners = rings.emplace_back(Json::array());
      for (const auto& at : ring) corners.push_back({degrees(at.x()), degrees(at.y())});
    }
    json.push_back({{"kind", std::ranges::find(kKinds, covering.kind, &KindName::kind)->name},
                    {"height_m", covering.height_m},
                    {"sd_m", covering.sd_m},
                    {"rings", rings}});
  }
  return json.dump() + "\n";
}

std::vector<Covering> parse_coverings(std::string_view coverings_text) {
  const Json json = parse(coverings_text);
  if (!json.is_array()) throw std::invalid_argument("is not a list");
  std::vector<Covering> coverings;
  for (const Json& covering : json) coverings.push_back(covering_from(covering));
  return coverings;
}

}  // namespace ols::land
