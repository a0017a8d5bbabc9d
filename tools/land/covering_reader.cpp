#include "tools/land/covering_reader.h"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "geometry/angles.h"
#include "tools/land/gdal_files.h"

namespace ols::land {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kPerLevel_m = 3.0;
constexpr double kTallest_m = 900.0;  // of what people have built; trees stay below 120 m
// 1-sigma: of a stated height, for each storey, and of a wood as a share of its height.
constexpr double kStatedSd_m = 1.0, kPerLevelSd_m = 0.5, kWoodSd = 0.2;

// Why features are left out: how many, and the first.
class LeftOut {
 public:
  LeftOut(std::string file, std::string why) : file_(std::move(file)), why_(std::move(why)) {}
  void add(GIntBig feature, const OGREnvelope& at) {
    if (count_++ > 0) return;
    std::ostringstream first;
    first.precision(8);
    first << "feature " << feature;
    if (std::isfinite(at.MinY)) first << " at " << at.MinY << ", " << at.MinX;
    first_ = first.str();
  }
  void tell(std::vector<std::string>& notes) const {
    if (count_ == 0) return;
    notes.push_back(file_ + ": " + std::to_string(count_) + ' ' + why_ +
                    ", left out, the first is " + first_);
  }

 private:
  std::string file_, why_, first_;
  std::size_t count_ = 0;
};

// The value of a field, or of one of OSM's other tags: "key"=>"value".
std::string attribute(const OGRFeature& feature, const std::string& name) {
  const int field = feature.GetFieldIndex(name.c_str());
  if (field >= 0 && feature.IsFieldSetAndNotNull(field)) return feature.GetFieldAsString(field);
  const int others = feature.GetFieldIndex("other_tags");
  if (others < 0 || !feature.IsFieldSetAndNotNull(others)) return "";
  const std::string tags = feature.GetFieldAsString(others);
  const std::string key = '"' + name + "\"=>\"";
  const auto at = tags.find(key);
  if (at == std::string::npos) return "";
  const auto value = at + key.size();
  return tags.substr(value, tags.find('"', value) - value);
}

std::string first_of(const OGRFeature& feature, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (std::string text = attribute(feature, name); !text.empty()) return text;
  }
  return "";
}

struct Height {
  double height_m = kNotKnown, sd_m = 0.0;
};

Height height_of(const OGRFeature& feature, CoveringKind kind) {
  const std::string stated = first_of(feature, {"height", "building:height", "building_height"});
  if (const double height_m = parse_height_m(stated); !std::isnan(height_m)) {
    return {height_m, kind == CoveringKind::kWood ? kWoodSd * height_m : kStatedSd_m};
  }
  const double levels =
      parse_height_m(first_of(feature, {"building:levels", "levels", "building_levels"}));
  return {levels * kPerLevel_m, std::hypot(kStatedSd_m, levels * kPerLevelSd_m)};
}

bool is_finite(const OGRLineString& ring) {
  for (int i = 0; i < ring.getNumPoints(); ++i) {
    const bool on_earth = std::abs(ring.getX(i)) <= 180.0 && std::abs(ring.getY(i)) <= 90.0;
    if (!on_earth) return false;  // NaN, too
  }
  return ring.getNumPoints() >= 4;
}

void add_rings(const OGRPolygon& polygon, Covering& covering) {
  for (const OGRLinearRing* ring : polygon) {
    auto& corners = covering.rings.emplace_back();
    for (int i = 0; i + 1 < ring->getNumPoints(); ++i) {  // the last is the first
      corners.emplace_back(radians(ring->getX(i)), radians(ring->getY(i)));
    }
  }
}

std::vector<const OGRPolygon*> polygons_of(const OGRGeometry& geometry) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) return {geometry.toPolygon()};
  std::vector<const OGRPolygon*> polygons;
  if (type != wkbMultiPolygon) return polygons;
  for (const OGRPolygon* polygon : *geometry.toMultiPolygon()) polygons.push_back(polygon);
  return polygons;
}

class Reader {
 public:
  Reader(const std::string& path, CoveringKind kind, const Bounds& bounds)
      : name_(std::filesystem::path(path).filename().string()), kind_(kind), bounds_(bounds) {
    wgs84_.importFromEPSG(4326);
    wgs84_.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  }

  void read(OGRLayer& layer) {
    const OGRSpatialReference* own = layer.GetSpatialRef();
    if (own != nullptr && !own->IsSame(&wgs84_)) {
      to_wgs84_.reset(OGRCreateCoordinateTransformation(own, &wgs84_));
    } else {
      to_wgs84_.reset();
    }
    for (const OGRFeatureUniquePtr& feature : layer) add(*feature);
  }

  ReadCoverings take() {
    for (const LeftOut* why : {&no_height_, &absurd_, &no_place_, &no_area_})
      why->tell(read_.notes);
    read_.notes.push_back(name_ + ": " + std::to_string(read_.coverings.size()) + ' ' +
                          (kind_ == CoveringKind::kWood ? "woods" : "buildings"));
    return std::move(read_);
  }

 private:
  void add(OGRFeature& feature) {
    OGRGeometry* geometry = feature.GetGeometryRef();
    const bool moved =
        geometry == nullptr || !to_wgs84_ || geometry->transform(to_wgs84_.get()) == OGRERR_NONE;
    const auto polygons =
        geometry == nullptr ? std::vector<const OGRPolygon*>() : polygons_of(*geometry);
    OGREnvelope box;
    if (geometry != nullptr) geometry->getEnvelope(&box);
    if (polygons.empty()) {  // OSM has points and lines of much else
      if (!std::isnan(height_of(feature, kind_).height_m)) no_area_.add(feature.GetFID(), box);
      return;
    }
    const bool is_placed = moved && std::ranges::all_of(polygons, [](const OGRPolygon* polygon) {
                             return std::ranges::all_of(*polygon, [](const OGRLinearRing* ring) {
                               return is_finite(*ring);
                             });
                           });
    if (!is_placed) return no_place_.add(feature.GetFID(), box);
    const double turns = turns_deg(bounds_, box.MinX);
    if (box.MaxX + turns < bounds_.west_deg || box.MinX + turns > bounds_.east_deg ||
        box.MaxY < bounds_.south_deg || box.MinY > bounds_.north_deg) {
      return;
    }
    const Height height = height_of(feature, kind_);
    if (std::isnan(height.height_m)) return no_height_.add(feature.GetFID(), box);
    if (!(height.height_m > 0.0 && height.height_m <= kTallest_m)) {
      return absurd_.add(feature.GetFID(), box);
    }
    Covering& covering = read_.coverings.emplace_back();
    covering.kind = kind_;
    covering.height_m = height.height_m;
    covering.sd_m = height.sd_m;
    for (const OGRPolygon* polygon : polygons) add_rings(*polygon, covering);
  }

  std::string name_;
  CoveringKind kind_;
  Bounds bounds_;
  OGRSpatialReference wgs84_;
  std::unique_ptr<OGRCoordinateTransformation> to_wgs84_;
  ReadCoverings read_;
  LeftOut no_height_{name_, "have neither height nor levels"};
  LeftOut absurd_{name_, "have absurd heights"};
  LeftOut no_place_{name_, "have no outline on the Earth"};
  LeftOut no_area_{name_, "have a height and no area"};
};

}  // namespace

double parse_height_m(const std::string& stated) {
  const std::string text = stated.substr(std::min(stated.size(), stated.find_first_not_of(" \t")));
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc()) return kNotKnown;
  std::string unit(rest, end);
  std::erase(unit, ' ');
  if (unit.empty() || unit == "m") return value;
  return unit == "ft" || unit == "'" ? 0.3048 * value : kNotKnown;
}

ReadCoverings read_coverings(const std::string& path, CoveringKind kind, const Bounds& bounds) {
  const QuietGdal quiet;
  GDALAllRegister();
  const Dataset dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  if (!dataset) {
    throw std::runtime_error(path + ": is no file of polygons that GDAL reads: " + gdal_error());
  }
  Reader reader(path, kind, bounds);
  for (OGRLayer* layer : dataset->GetLayers()) reader.read(*layer);
  if (CPLGetLastErrorType() == CE_Failure) {
    throw std::runtime_error(path + ": is damaged: " + gdal_error());
  }
  return reader.take();
}

}  // namespace ols::land
