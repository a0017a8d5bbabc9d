#include "tools/offline/coverage_files.h"

#include <gdal_alg.h>
#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "base/files/atomic_file.h"
#include "geometry/angles.h"
#include "tools/land/gdal_files.h"
#include "tools/offline/geojson.h"

namespace ols::offline {
namespace {

using nlohmann::json;

using land::Dataset;

struct Column {
  std::string name;
  std::vector<float> values;  // by cell; NaN: none
};

std::vector<Column> columns_of(const Coverage& coverage) {
  const auto column = [&](const std::string& name, const auto& value_of) {
    Column made{name, {}};
    for (const CoverageCell& cell : coverage.cells) {
      const std::optional<double> value = value_of(cell);
      made.values.push_back(
          static_cast<float>(value.value_or(std::numeric_limits<double>::quiet_NaN())));
    }
    return made;
  };
  std::vector<Column> columns{column("ground_m", [](const auto& cell) { return cell.ground_m; }),
                              column("one_m", [](const auto& cell) { return cell.one_m; }),
                              column("two_m", [](const auto& cell) { return cell.two_m; })};
  for (std::size_t i = 0; i < coverage.heights_m.size(); ++i) {
    std::ostringstream name;
    name << "error_" << coverage.heights_m[i] << "_m";
    columns.push_back(column(name.str(), [i](const auto& cell) { return cell.errors_m[i]; }));
  }
  return columns;
}

// A georeferenced raster in memory; CreateCopy makes a file of it.
Dataset raster(const Lattice& lattice, int bands, GDALDataType type) {
  GDALAllRegister();
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  Dataset dataset(memory == nullptr
                      ? nullptr
                      : memory->Create("", static_cast<int>(lattice.columns),
                                       static_cast<int>(lattice.rows), bands, type, nullptr));
  if (!dataset) throw std::runtime_error("GDAL makes no raster");
  const double east_deg = degrees(lattice.step_longitude_rad);
  const double south_deg = degrees(lattice.step_latitude_rad);
  // GDAL's origin is the corner of the first cell.
  std::array transform{degrees(lattice.west_rad) - 0.5 * east_deg,   east_deg, 0.0,
                       degrees(lattice.north_rad) + 0.5 * south_deg, 0.0,      -south_deg};
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  dataset->SetGeoTransform(transform.data());
  dataset->SetSpatialRef(&wgs84);
  return dataset;
}

template <typename Value>
void fill_band(GDALDataset& dataset, int band, std::vector<Value>& values, GDALDataType type) {
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  if (dataset.GetRasterBand(band)->RasterIO(GF_Write, 0, 0, columns, rows, values.data(), columns,
                                            rows, type, 0, 0) != CE_None) {
    throw std::runtime_error("GDAL takes no raster");
  }
}

std::string bytes_of_geotiff(GDALDataset& dataset) {
  constexpr const char* kPath = "/vsimem/coverage.tif";
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  std::array<char, 17> deflate{"COMPRESS=DEFLATE"};
  std::array<char*, 2> options{deflate.data(), nullptr};
  Dataset copy(driver == nullptr
                   ? nullptr
                   : driver->CreateCopy(kPath, &dataset, 0, options.data(), nullptr, nullptr));
  if (!copy) throw std::runtime_error("GDAL makes no GeoTIFF");
  copy.reset();  // written when it is closed
  vsi_l_offset length = 0;
  GByte* bytes = VSIGetMemFileBuffer(kPath, &length, TRUE);
  const std::unique_ptr<GByte, decltype(&VSIFree)> freed(bytes, &VSIFree);
  return {reinterpret_cast<const char*>(bytes), length};
}

void write(const std::string& path, const std::string& bytes) {
  AtomicFile file(path);
  file.stream() << bytes;
  file.commit();
}

// The outlines of the cells where two stations see at this height, as a MultiPolygon.
json outline(const Coverage& coverage, double height_m) {
  std::vector<GByte> seen;
  for (const CoverageCell& cell : coverage.cells) {
    seen.push_back(cell.two_m && *cell.two_m <= height_m ? 1 : 0);
  }
  const Dataset mask = raster(coverage.lattice, 1, GDT_Byte);
  fill_band(*mask, 1, seen, GDT_Byte);
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("Memory");
  const Dataset shapes(memory == nullptr ? nullptr
                                         : memory->Create("", 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer* layer = shapes ? shapes->CreateLayer("seen", nullptr, wkbPolygon, nullptr) : nullptr;
  GDALRasterBand* band = mask->GetRasterBand(1);
  if (layer == nullptr ||
      GDALPolygonize(GDALRasterBand::ToHandle(band), GDALRasterBand::ToHandle(band),
                     OGRLayer::ToHandle(layer), -1, nullptr, nullptr, nullptr) != CE_None) {
    throw std::runtime_error("GDAL makes no outlines");
  }
  json polygons = json::array();
  for (const auto& feature : *layer) {
    char* text = feature->GetGeometryRef()->exportToJson();
    polygons.push_back(json::parse(text).at("coordinates"));
    CPLFree(text);
  }
  return {{"type", "MultiPolygon"}, {"coordinates", polygons}};
}

}  // namespace

void write_coverage_csv(const std::string& path, const Coverage& coverage) {
  const auto columns = columns_of(coverage);
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "latitude_deg,longitude_deg";
  for (const Column& column : columns) out << ',' << column.name;
  out << '\n' << std::fixed;
  for (std::size_t i = 0; i < coverage.cells.size(); ++i) {
    const Geodetic centre = coverage.lattice.centre(i);
    out << std::setprecision(7) << degrees(centre.latitude_rad) << ','
        << degrees(centre.longitude_rad) << std::setprecision(2);
    for (const Column& column : columns) {
      out << ',';
      if (!std::isnan(column.values[i])) out << column.values[i];
    }
    out << '\n';
  }
  file.commit();
}

void write_coverage_geotiff(const std::string& path, const Coverage& coverage) {
  auto columns = columns_of(coverage);
  const Dataset dataset = raster(coverage.lattice, static_cast<int>(columns.size()), GDT_Float32);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    GDALRasterBand& band = *dataset->GetRasterBand(number);
    band.SetDescription(columns[i].name.c_str());
    band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
    fill_band(*dataset, number, columns[i].values, GDT_Float32);
  }
  write(path, bytes_of_geotiff(*dataset));
}

void write_coverage_geojson(const std::string& path, const Coverage& coverage,
                            const std::vector<StationRow>& stations) {
  json features = json::array();
  for (const StationRow& row : stations) {
    features.push_back(
        station_feature(row.station, {row.longitude_deg, row.latitude_deg, row.height_m}));
  }
  for (const double height_m : coverage.heights_m) {
    features.push_back({{"type", "Feature"},
                        {"geometry", outline(coverage, height_m)},
                        {"properties", {{"above_ground_m", height_m}}}});
  }
  write(path, json{{"type", "FeatureCollection"}, {"features", features}}.dump() + '\n');
}

}  // namespace ols::offline
