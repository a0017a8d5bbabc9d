#include "tools/land/elevation_reader.h"

#include <gdal_alg.h>
#include <gdal_utils.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "conditions/printed.h"
#include "geometry/angles.h"
#include "tools/land/gdal_files.h"

namespace ols::land {
namespace {

constexpr double kLowest_m = -500.0, kHighest_m = 9'000.0;  // of the Earth's land

using Affine = std::array<double, 6>;  // GDAL's: of corners of pixels

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

Dataset open(const std::string& path) {
  const auto as_raster = [](const std::string& name) {
    return Dataset(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
  };
  Dataset dataset = as_raster(path);
  if (!dataset && path.ends_with(".zip")) dataset = as_raster("/vsizip/" + path);
  if (!dataset) fail(path, "is no elevation model that GDAL reads: " + gdal_error());
  if (dataset->GetRasterCount() < 1) fail(path, "has no heights");
  return dataset;
}

Affine affine_of(GDALDataset& dataset, const std::string& path) {
  Affine affine{};
  if (dataset.GetGeoTransform(affine.data()) != CE_None) fail(path, "does not state its place");
  return affine;
}

double metres_per_unit(GDALRasterBand& band, const std::string& path) {
  const std::string unit = band.GetUnitType();
  if (unit.empty() || unit == "m" || unit == "metre" || unit == "meter") return 1.0;
  if (unit == "ft" || unit == "foot") return 0.3048;
  if (unit == "US survey foot" || unit == "ftUS") return 1200.0 / 3937.0;
  fail(path, "its heights are in \"" + unit + "\", which is not known");
}

// Whether latitudes and longitudes of the system are those of WGS84, to a metre; ETRS89 and NAD83
// are.
bool is_wgs84(OGRSpatialReference system, double latitude_deg, double longitude_deg) {
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  for (auto* one : {&system, &wgs84}) one->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> to_wgs84(
      OGRCreateCoordinateTransformation(&system, &wgs84));
  double x = longitude_deg, y = latitude_deg;
  return to_wgs84 && to_wgs84->Transform(1, &x, &y) != 0 && std::abs(x - longitude_deg) < 1e-5 &&
         std::abs(y - latitude_deg) < 1e-5;
}

// Resamples to a lattice of latitude and longitude whose heights are at multiples of its own
// resolution, so that neighbouring files of one model have the same lattice.
Dataset resample(GDALDataset& source, const Bounds& bounds, const std::string& path) {
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  char* text = nullptr;
  wgs84.exportToWkt(&text);
  const std::string wkt = text;
  CPLFree(text);
  void* transformer =
      GDALCreateGenImgProjTransformer(&source, nullptr, nullptr, wkt.c_str(), FALSE, 0.0, 1);
  if (transformer == nullptr) fail(path, "its coordinate system is not known: " + gdal_error());
  Affine affine{};
  int columns = 0, rows = 0;
  const CPLErr suggested = GDALSuggestedWarpOutput(&source, GDALGenImgProjTransform, transformer,
                                                   affine.data(), &columns, &rows);
  GDALDestroyGenImgProjTransformer(transformer);
  if (suggested != CE_None)
    fail(path, "cannot be brought to latitude and longitude: " + gdal_error());
  // Two digits: files of one model get the same step.
  const std::string step = printed("%.1e", affine[1]);
  const double step_deg = std::stod(step);
  const double west = std::max(bounds.west_deg, affine[0]);
  const double north = std::min(bounds.north_deg, affine[3]);
  const double east = std::min(bounds.east_deg, affine[0] + columns * affine[1]);
  const double south = std::max(bounds.south_deg, affine[3] - rows * affine[1]);
  if (!(west < east && south < north)) return nullptr;
  if ((east - west) * (north - south) > kMostHeights * step_deg * step_deg) {
    fail(path, "has too many heights within the radius: take a smaller one, or a coarser model");
  }
  char** words = nullptr;
  const auto number = [](double value) {
    std::ostringstream out;
    out.precision(15);
    out << value;
    return out.str();
  };
  for (const std::string& word : {std::string("-of"),
                                  std::string("MEM"),
                                  std::string("-t_srs"),
                                  std::string("EPSG:4326"),
                                  std::string("-r"),
                                  std::string("bilinear"),
                                  std::string("-ot"),
                                  std::string("Float32"),
                                  std::string("-dstnodata"),
                                  std::string("nan"),
                                  std::string("-novshift"),
                                  std::string("-tr"),
                                  number(step_deg),
                                  number(step_deg),
                                  std::string("-tap"),
                                  std::string("-te"),
                                  number(west),
                                  number(south),
                                  number(east),
                                  number(north)}) {
    words = CSLAddString(words, word.c_str());
  }
  GDALWarpAppOptions* options = GDALWarpAppOptionsNew(words, nullptr);
  CSLDestroy(words);
  GDALDatasetH sources[] = {&source};
  int misused = 0;
  Dataset result(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, sources, options, &misused)));
  GDALWarpAppOptionsFree(options);
  if (!result) fail(path, "cannot be brought to latitude and longitude: " + gdal_error());
  return result;
}

// The part within the bounds and one height around it.
std::optional<Raster> crop(GDALDataset& dataset, const Bounds& bounds, const std::string& path) {
  const Affine affine = affine_of(dataset, path);
  Raster raster{.name = std::filesystem::path(path).filename().string(),
                .step_latitude_deg = -affine[5],
                .step_longitude_deg = affine[1]};
  const auto first = [](double at, int count) {
    return std::clamp(static_cast<int>(std::floor(at)), 0, count);
  };
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  const double turns = turns_deg(bounds, affine[0] + 0.5 * columns * affine[1]);
  const double west_deg = affine[0] + 0.5 * affine[1] + turns,
               north_deg = affine[3] + 0.5 * affine[5];
  const int left = first((bounds.west_deg - west_deg) / affine[1], columns);
  const int right = first((bounds.east_deg - west_deg) / affine[1] + 2.0, columns);
  const int top = first((north_deg - bounds.north_deg) / raster.step_latitude_deg, rows);
  const int bottom = first((north_deg - bounds.south_deg) / raster.step_latitude_deg + 2.0, rows);
  raster.columns = right - left;
  raster.rows = bottom - top;
  if (raster.columns < 2 || raster.rows < 2) return std::nullopt;
  if (static_cast<double>(raster.columns) * raster.rows > kMostHeights) {
    fail(path, "has too many heights within the radius: take a smaller one, or a coarser model");
  }
  raster.west_deg = west_deg + left * affine[1];
  raster.north_deg = north_deg - top * raster.step_latitude_deg;
  raster.heights_m.resize(static_cast<std::size_t>(raster.columns) *
                          static_cast<std::size_t>(raster.rows));
  if (dataset.GetRasterBand(1)->RasterIO(GF_Read, left, top, raster.columns, raster.rows,
                                         raster.heights_m.data(), raster.columns, raster.rows,
                                         GDT_Float32, 0, 0, nullptr) != CE_None) {
    fail(path, "is damaged: " + gdal_error());
  }
  return raster;
}

struct BandMeaning {
  double void_value = std::numeric_limits<double>::quiet_NaN();
  double scale = 1.0, offset = 0.0;  // to metres
};

// Voids become NaN; so do heights that no land of the Earth has, with a note.
void interpret(Raster& raster, const BandMeaning& band, std::vector<std::string>& notes) {
  std::size_t voids = 0, absurd = 0, first_absurd = 0;
  float absurd_m = 0.0F;
  for (std::size_t i = 0; i < raster.heights_m.size(); ++i) {
    float& height = raster.heights_m[i];
    const bool is_void = std::isnan(height) || double{height} == band.void_value;
    const double height_m = height * band.scale + band.offset;
    voids += is_void;
    if (!is_void && !(height_m >= kLowest_m && height_m <= kHighest_m)) {
      if (absurd++ == 0) {
        first_absurd = i;
        absurd_m = static_cast<float>(height_m);
      }
    }
    const bool is_known = !is_void && height_m >= kLowest_m && height_m <= kHighest_m;
    height = is_known ? static_cast<float>(height_m) : std::numeric_limits<float>::quiet_NaN();
  }
  if (voids > 0) notes.push_back(raster.name + ": " + std::to_string(voids) + " heights are void");
  if (absurd > 0) {
    std::ostringstream note;
    note.precision(8);
    const auto columns = static_cast<std::size_t>(raster.columns);
    note << raster.name << ": " << absurd << " heights are absurd and count as void, the first is "
         << absurd_m << " m at " << raster.latitude_deg(static_cast<int>(first_absurd / columns))
         << ", " << raster.longitude_deg(static_cast<int>(first_absurd % columns));
    notes.push_back(note.str());
  }
}

BandMeaning meaning_of(GDALDataset& dataset, const std::string& path) {
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  const double metres = metres_per_unit(band, path);
  BandMeaning meaning{.scale = metres * band.GetScale(), .offset = metres * band.GetOffset()};
  int has_void = 0;
  const double void_value = band.GetNoDataValue(&has_void);
  if (has_void != 0) meaning.void_value = void_value;
  return meaning;
}

}  // namespace

Bounds bounds_around(double latitude_deg, double longitude_deg, double radius_km) {
  const double up_deg = degrees(radius_km / 6'371.0);
  const double across_deg = up_deg / std::max(0.01, std::cos(radians(latitude_deg)));
  return {latitude_deg - up_deg, latitude_deg + up_deg, longitude_deg - across_deg,
          longitude_deg + across_deg};
}

double turns_deg(const Bounds& bounds, double longitude_deg) {
  const double middle_deg = 0.5 * (bounds.west_deg + bounds.east_deg);
  return 360.0 * std::round((middle_deg - longitude_deg) / 360.0);
}

ReadElevation read_elevation(const std::string& path, const Bounds& bounds) {
  const QuietGdal quiet;
  GDALAllRegister();
  Dataset dataset = open(path);
  const OGRSpatialReference* system = dataset->GetSpatialRef();
  if (system == nullptr) fail(path, "does not state its coordinate system");
  const Affine affine = affine_of(*dataset, path);
  BandMeaning meaning = meaning_of(*dataset, path);
  ReadElevation read;
  const bool is_lattice = system->IsGeographic() && affine[2] == 0.0 && affine[4] == 0.0 &&
                          affine[5] < 0.0 &&
                          is_wgs84(*system, affine[3] + 0.5 * dataset->GetRasterYSize() * affine[5],
                                   affine[0] + 0.5 * dataset->GetRasterXSize() * affine[1]);
  if (!is_lattice) {
    dataset = resample(*dataset, bounds, path);
    meaning.void_value = std::numeric_limits<double>::quiet_NaN();
    if (!dataset) return read;
    read.notes.push_back(std::filesystem::path(path).filename().string() +
                         ": is resampled to latitude and longitude");
  }
  read.raster = crop(*dataset, bounds, path);
  if (read.raster) interpret(*read.raster, meaning, read.notes);
  return read;
}

}  // namespace ols::land
