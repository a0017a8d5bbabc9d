// ols-precision coverage and vertical: what stations see over the land.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/progress.h"
#include "geometry/angles.h"
#include "land/lowest_visible.h"
#include "tools/offline/coverage.h"
#include "tools/offline/coverage_files.h"
#include "tools/offline/near_place.h"
#include "tools/offline/precision_options.h"
#include "tools/offline/precision_site_files.h"

namespace ols::offline {
namespace {

struct SiteOptions {
  std::string stations, land, output;
  double reach_m = 5000.0;
};

struct CoverageOptions {
  MeasurementOptions measurement;
  SiteOptions site;
  std::string geojson, geotiff;
  std::vector<double> heights_m = {10.0, 30.0, 100.0, 300.0};
  double spacing_m = 50.0;
};

struct VerticalOptions {
  SiteOptions site;
  std::vector<double> azimuths_deg = {0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0};
  double step_m = 25.0;
};

Geodetic place_of(const StationRow& row) {
  return {radians(row.latitude_deg), radians(row.longitude_deg), row.height_m};
}

std::vector<StationRow> stations_of(const SiteOptions& o) {
  const auto rows = read_stations(o.stations);
  for (const StationRow& row : rows) {
    require_near(o.stations + ": " + row.station, place_of(row), {place_of(rows.front())},
                 "station " + rows.front().station);
  }
  return rows;
}

Geodetic middle_of(const std::vector<StationRow>& rows) {
  const LocalFrame frame(place_of(rows.front()));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const StationRow& row : rows) sum += frame.to_enu(ecef_from_geodetic(place_of(row)));
  return geodetic_from_ecef(frame.to_ecef(sum / static_cast<double>(rows.size())));
}

// Each view reaches to the farthest corner of a square of 2 `reach_m` around `middle`.
std::vector<LandView> views_of(const SiteOptions& o, const std::vector<StationRow>& rows,
                               const Geodetic& middle, const PlannedLand& land,
                               const MeasurementOptions& measurement) {
  std::vector<LandView> views;
  for (const StationRow& row : rows) {
    const PlannedStation station = planned_station(row, measurement);
    const double off_m = (station.place.origin_ecef() - ecef_from_geodetic(middle)).norm();
    views.push_back({station, land.look(o.stations + ": " + row.station, place_of(row),
                                        off_m + std::sqrt(2.0) * o.reach_m)});
  }
  return views;
}

double quantile(std::vector<double> values, double part) {
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

void tell(const Coverage& coverage) {
  std::size_t known = 0;
  for (const CoverageCell& cell : coverage.cells) known += cell.ground_m ? 1 : 0;
  const auto percent = [&](std::size_t count) {
    return std::lround(100.0 * static_cast<double>(count) / static_cast<double>(known));
  };
  if (known < coverage.cells.size()) {
    std::cerr << "ols-precision: the land is not known in " << coverage.cells.size() - known
              << " of " << coverage.cells.size() << " cells\n";
  }
  std::cout << "above ground   seen by one   by two   3-D error: median, 95 %\n";
  for (std::size_t i = 0; i < coverage.heights_m.size(); ++i) {
    const double height_m = coverage.heights_m[i];
    std::size_t one = 0, two = 0;
    std::vector<double> errors_m;
    for (const CoverageCell& cell : coverage.cells) {
      one += cell.one_m && *cell.one_m <= height_m ? 1 : 0;
      two += cell.two_m && *cell.two_m <= height_m ? 1 : 0;
      if (cell.errors_m[i]) errors_m.push_back(*cell.errors_m[i]);
    }
    std::cout << std::setw(10) << height_m << " m" << std::setw(12) << percent(one) << " %"
              << std::setw(7) << percent(two) << " %";
    if (!errors_m.empty()) {
      std::cout << std::setprecision(3) << std::setw(12) << quantile(errors_m, 0.5) << " m, "
                << quantile(errors_m, 0.95) << " m";
    }
    std::cout << '\n';
  }
}

void write_coverage(const CoverageOptions& o) {
  check_outputs({{"--stations", o.site.stations}},
                {{"--output", o.site.output}, {"--geojson", o.geojson}, {"--geotiff", o.geotiff}});
  const auto rows = stations_of(o.site);
  const Geodetic middle = middle_of(rows);
  const Lattice lattice = lattice_around(middle, o.site.reach_m, o.spacing_m);
  const PlannedLand land(o.site.land);
  const auto views = views_of(o.site, rows, middle, land, o.measurement);
  std::vector<double> heights_m = o.heights_m;
  std::ranges::sort(heights_m);
  const auto target = [&](const Geodetic& place) { return planned_target(place, o.measurement); };
  const Coverage coverage = cover(lattice, heights_m, views, land, target, o.measurement.exposures,
                                  Progress("ols-precision", "cells"));
  const auto known = [](const CoverageCell& cell) { return cell.ground_m.has_value(); };
  if (std::ranges::none_of(coverage.cells, known)) {
    throw std::invalid_argument(o.site.land + ": knows no ground around " + o.site.stations);
  }
  write_coverage_csv(o.site.output, coverage);
  if (!o.geotiff.empty()) write_coverage_geotiff(o.geotiff, coverage);
  if (!o.geojson.empty()) write_coverage_geojson(o.geojson, coverage, rows);
  tell(coverage);
}

void write_vertical(const VerticalOptions& o) {
  check_outputs({{"--stations", o.site.stations}}, {{"--output", o.site.output}});
  const auto rows = stations_of(o.site);
  const PlannedLand land(o.site.land);
  AtomicFile file(o.site.output);
  std::ostream& out = file.stream();
  out << "station,azimuth_deg,distance_m,ground_m,lowest_m\n" << std::fixed;
  for (const StationRow& row : rows) {
    const auto map = land.look(o.site.stations + ": " + row.station, place_of(row), o.site.reach_m);
    const LocalFrame frame(place_of(row));
    for (const double azimuth_deg : o.azimuths_deg) {
      const double azimuth = radians(azimuth_deg);
      for (double d = o.step_m; d <= o.site.reach_m; d += o.step_m) {
        const Geodetic place =
            geodetic_from_ecef(frame.to_ecef({d * std::sin(azimuth), d * std::cos(azimuth), 0.0}));
        const auto ground_m = land.ground_m(place);
        const auto lowest_m = land::lowest_visible_m(*map, place.latitude_rad, place.longitude_rad);
        out << row.station << ',' << std::setprecision(2) << azimuth_deg << ',' << d << ',';
        if (ground_m) out << *ground_m;
        out << ',';
        if (lowest_m) out << std::max(*lowest_m, ground_m.value_or(*lowest_m));
        out << '\n';
      }
    }
  }
  file.commit();
}

void add_site_options(CLI::App& app, SiteOptions& o) {
  app.add_option("--stations", o.stations, "CSV: station,latitude_deg,longitude_deg,height_m")
      ->required();
  app.add_option("--land", o.land, "folder of ols-land import")->required();
  app.add_option("--reach", o.reach_m, "[m] how far to look")
      ->check(CLI::Range(10.0, 2e5))
      ->capture_default_str();
  app.add_option("--output", o.output, "CSV; tools/precision-plot makes a PNG of it")->required();
}

}  // namespace

void add_coverage(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "coverage", "From which heights above the land on stations see, and how well they locate.");
  auto o = std::make_shared<CoverageOptions>();
  add_site_options(*command, o->site);
  command->add_option("--heights", o->heights_m, "[m] above the ground")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
  command->add_option("--spacing", o->spacing_m, "[m] of the cells")
      ->check(CLI::Range(0.1, 1e5))
      ->capture_default_str();
  command->add_option("--geotiff", o->geotiff, "the same as bands of a raster");
  command->add_option("--geojson", o->geojson, "outlines of what two stations see, by height");
  add_measurement_options(*command, o->measurement);
  command->callback([o] { write_coverage(*o); });
}

void add_vertical(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "vertical", "Each station's lowest visible height by distance, along azimuths.");
  auto o = std::make_shared<VerticalOptions>();
  add_site_options(*command, o->site);
  command->add_option("--azimuths", o->azimuths_deg, "[deg] clockwise from true north")
      ->delimiter(',')
      ->check(CLI::Range(-360.0, 360.0))
      ->capture_default_str();
  command->add_option("--step", o->step_m, "[m] between rows")
      ->check(CLI::Range(0.1, 1e4))
      ->capture_default_str();
  command->callback([o] { write_vertical(*o); });
}

}  // namespace ols::offline
