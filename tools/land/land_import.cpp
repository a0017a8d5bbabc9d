#include "tools/land/land_import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "geometry/angles.h"
#include "land/geoid.h"
#include "land/terrain_folder.h"
#include "tools/land/covering_reader.h"
#include "tools/land/elevation_reader.h"
#include "tools/land/mosaic.h"
#include "tools/land/scenery_coverings.h"

namespace ols::land {
namespace {

constexpr const char* kEllipsoid = "ellipsoid";
constexpr const char* kEgm96 = "egm96_15.gtx";

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

// Heights of SRTM and DTED are above EGM96 by definition.
std::string heights_of(const std::string& path, const std::string& stated) {
  if (!stated.empty()) return stated;
  const std::string name = name_of(path);
  for (const char* kind : {".hgt", ".dt0", ".dt1", ".dt2", ".HGT", ".DT0", ".DT1", ".DT2"}) {
    if (name.find(kind) != std::string::npos) return kEgm96;
  }
  throw std::runtime_error(path +
                           ": does not say what its heights are above: --heights egm96_15.gtx, "
                           "another grid of PROJ, or ellipsoid");
}

void lift_to_ellipsoid(Raster& raster, const Geoid& geoid) {
  float* height = raster.heights_m.data();
  for (int row = 0; row < raster.rows; ++row) {
    for (int column = 0; column < raster.columns; ++column, ++height) {
      if (std::isnan(*height)) continue;
      *height += static_cast<float>(geoid.height_m(
          raster.latitude_deg(row), std::remainder(raster.longitude_deg(column), 360.0)));
    }
  }
}

class Import {
 public:
  explicit Import(const ImportOptions& options)
      : options_(options),
        bounds_(bounds_around(options.latitude_deg, options.longitude_deg, options.radius_km)) {
    manifest_.latitude_deg = options.latitude_deg;
    manifest_.longitude_deg = options.longitude_deg;
    manifest_.radius_km = options.radius_km;
  }

  std::vector<std::string> run() {
    for (const std::string& path : options_.elevation) add_elevation(path);
    if (rasters_.empty()) throw std::runtime_error(elsewhere());
    Mosaic mosaic = join(rasters_, options_.sd_m, options_.accept_seams);
    for (NewGrid& grid : mosaic.grids) {
      if (grid.form.west_deg < -180.0) grid.form.west_deg += 360.0;
    }
    note(mosaic.notes);
    check_cover(mosaic);
    for (const std::string& path : options_.buildings) {
      add_coverings(path, read_coverings(path, CoveringKind::kBuilding, bounds_), "buildings");
    }
    for (const std::string& path : options_.woods) {
      add_coverings(path, read_coverings(path, CoveringKind::kWood, bounds_), "woods");
    }
    for (const std::string& path : options_.scenery) {
      add_coverings(path, read_scenery_coverings(path, bounds_), "scenery");
    }
    write_terrain_folder(options_.output, manifest_, mosaic.grids, coverings_);
    return manifest_.notes;
  }

 private:
  void note(const std::vector<std::string>& notes) {
    manifest_.notes.insert(manifest_.notes.end(), notes.begin(), notes.end());
  }

  void add_elevation(const std::string& path) {
    const std::string heights = heights_of(path, options_.heights);
    ReadElevation read = read_elevation(path, bounds_);
    note(read.notes);
    if (!read.raster) {
      note({name_of(path) + ": is elsewhere, left out"});
      return;
    }
    if (heights != kEllipsoid) lift_to_ellipsoid(*read.raster, geoid(heights));
    manifest_.sources.push_back(
        {name_of(path), "elevation", options_.licence, heights, options_.sd_m});
    heights_ += static_cast<double>(read.raster->heights_m.size());
    if (heights_ > kMostHeights) {
      throw std::runtime_error(path + ": with it there are too many heights within the radius: " +
                               "take a smaller one, or a coarser model");
    }
    rasters_.push_back(std::move(*read.raster));
  }

  const Geoid& geoid(const std::string& grid) {
    auto& kept = geoids_[grid];
    if (!kept) {
      try {
        kept = std::make_unique<const Geoid>(grid);
      } catch (const std::invalid_argument& missing) {
        throw std::runtime_error(std::string("--heights: ") + missing.what());
      }
    }
    return *kept;
  }

  std::string elsewhere() const {
    std::ostringstream text;
    text.precision(8);
    text << "no elevation model has land within " << options_.radius_km << " km of "
         << options_.latitude_deg << ", " << options_.longitude_deg;
    for (const std::string& path : options_.elevation) text << "; not " << path;
    return text.str();
  }

  // The site's ground must be known; how much is known around it is reported.
  void check_cover(const Mosaic& mosaic) {
    std::vector<HeightGrid> grids;
    for (const NewGrid& grid : mosaic.grids)
      grids.push_back(height_grid(grid.form, grid.heights_m));
    const Terrain terrain(grids, {}, nullptr);
    constexpr int kPlaces = 200;  // in each direction
    int all = 0, known = 0;
    for (int i = 0; i < kPlaces; ++i) {
      for (int k = 0; k < kPlaces; ++k) {
        const double north = 2.0 * (i + 0.5) / kPlaces - 1.0,
                     east = 2.0 * (k + 0.5) / kPlaces - 1.0;
        if (std::hypot(north, east) > 1.0) continue;
        const double latitude_deg =
            options_.latitude_deg + north * 0.5 * (bounds_.north_deg - bounds_.south_deg);
        const double longitude_deg =
            options_.longitude_deg + east * 0.5 * (bounds_.east_deg - bounds_.west_deg);
        ++all;
        known += terrain.ground(radians(latitude_deg), wrap_pi(radians(longitude_deg))).has_value();
      }
    }
    if (!terrain.ground(radians(options_.latitude_deg), radians(options_.longitude_deg))) {
      throw std::runtime_error("the ground of the site itself is void: " + elsewhere());
    }
    std::ostringstream share;
    share.precision(3);
    share << 100.0 * known / all << " % of the area within " << options_.radius_km
          << " km is known";
    note({share.str()});
  }

  void add_coverings(const std::string& path, ReadCoverings read, const std::string& kind) {
    note(read.notes);
    double greatest_sd_m = 0.0;
    for (const Covering& one : read.coverings) greatest_sd_m = std::max(greatest_sd_m, one.sd_m);
    manifest_.sources.push_back({name_of(path), kind, options_.licence,
                                 kind == "scenery" ? kEllipsoid : "ground", greatest_sd_m});
    std::ranges::move(read.coverings, std::back_inserter(coverings_));
  }

  const ImportOptions& options_;
  Bounds bounds_;
  Manifest manifest_;
  std::vector<Raster> rasters_;
  double heights_ = 0.0;  // in rasters_
  std::vector<Covering> coverings_;
  std::map<std::string, std::unique_ptr<const Geoid>> geoids_;
};

}  // namespace

std::vector<std::string> import_land(const ImportOptions& options) {
  if (std::filesystem::exists(options.output))
    throw std::runtime_error(options.output + ": exists");
  return Import(options).run();
}

}  // namespace ols::land
