// ols-precision map: how well a position can be known over a site, at some heights.
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/progress.h"
#include "geometry/angles.h"
#include "tools/offline/geojson.h"
#include "tools/offline/near_place.h"
#include "tools/offline/precision_options.h"
#include "tools/offline/precision_site_files.h"

namespace ols::offline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using nlohmann::json;

struct MapOptions {
  MeasurementOptions measurement;
  std::string stations, output, geojson;
  std::vector<double> heights_m = {50.0};
  double margin_m = 0.0;
  int cells = 80;
};

// An even grid about the stations, east and north of their middle.
struct Grid {
  Geodetic middle;  // at the stations' mean height
  double half_east_m = 0.0, half_north_m = 0.0, spacing_m = 0.0;
};

struct Cell {
  Geodetic centre;
  std::optional<Matrix3d> covariance_enu;  // [m^2]
};

Grid grid_about(const std::vector<StationRow>& rows, const MapOptions& o) {
  Grid grid;
  const auto count = static_cast<double>(rows.size());
  const Geodetic first{radians(rows[0].latitude_deg), radians(rows[0].longitude_deg),
                       rows[0].height_m};
  const LocalFrame frame(first);
  Vector3d least = Vector3d::Constant(1e9), greatest = -least;
  for (const StationRow& row : rows) {
    const Vector3d p = frame.to_enu(
        ecef_from_geodetic({radians(row.latitude_deg), radians(row.longitude_deg), row.height_m}));
    least = least.cwiseMin(p);
    greatest = greatest.cwiseMax(p);
    grid.middle.height_m += row.height_m / count;
  }
  const double height_m = grid.middle.height_m;
  grid.middle = geodetic_from_ecef(frame.to_ecef(0.5 * (least + greatest)));
  grid.middle.height_m = height_m;
  const Vector3d half = 0.5 * (greatest - least);
  const double margin_m = o.margin_m > 0.0 ? o.margin_m : std::max(100.0, half.head<2>().norm());
  grid.half_east_m = half.x() + margin_m;
  grid.half_north_m = half.y() + margin_m;
  grid.spacing_m = 2.0 * std::max(grid.half_east_m, grid.half_north_m) / o.cells;
  return grid;
}

std::vector<Cell> cells_of(const Grid& grid, double above_m,
                           const std::vector<PlannedStation>& stations,
                           const MeasurementOptions& measurement, Progress& progress) {
  const LocalFrame frame(grid.middle);
  std::vector<Cell> cells;
  const int columns = static_cast<int>(grid.half_east_m / grid.spacing_m);
  const int rows = static_cast<int>(grid.half_north_m / grid.spacing_m);
  for (int row = -rows; row <= rows; ++row) {
    for (int column = -columns; column <= columns; ++column) {
      Cell cell;
      cell.centre =
          geodetic_from_ecef(frame.to_ecef({column * grid.spacing_m, row * grid.spacing_m, 0.0}));
      cell.centre.height_m = grid.middle.height_m + above_m;
      const auto precision = position_precision(stations, planned_target(cell.centre, measurement),
                                                measurement.exposures);
      if (precision) {
        const Matrix3d R = R_ecef_enu(cell.centre);
        cell.covariance_enu = R.transpose() * precision->covariance_ecef * R;
      }
      cells.push_back(cell);
      progress(cells.size(), static_cast<std::size_t>((2 * rows + 1) * (2 * columns + 1)));
    }
  }
  return cells;
}

void write_rows(std::ostream& out, double above_m, const std::vector<Cell>& cells) {
  for (const Cell& cell : cells) {
    out << std::setprecision(10) << degrees(cell.centre.latitude_rad) << ','
        << degrees(cell.centre.longitude_rad) << ',' << std::setprecision(6) << cell.centre.height_m
        << ',' << above_m;
    if (!cell.covariance_enu) {
      out << ",,,,,,,\n";
      continue;
    }
    const Matrix3d& C = *cell.covariance_enu;
    out << ',' << std::sqrt(C(0, 0)) << ',' << std::sqrt(C(1, 1)) << ',' << std::sqrt(C(2, 2))
        << ',' << C(0, 1) << ',' << C(0, 2) << ',' << C(1, 2) << ',' << std::sqrt(C(0, 0) + C(1, 1))
        << '\n';
  }
}

using Corner = std::array<double, 2>;  // [deg] longitude, latitude

// The cell's corners; longitudes go on across the date line.
std::vector<Corner> corners_of(const Cell& cell, double spacing_m) {
  const LocalFrame frame(cell.centre);
  const double h = 0.5 * spacing_m, middle_rad = cell.centre.longitude_rad;
  std::vector<Corner> corners;
  for (const auto& [east_m, north_m] : {std::pair(-h, -h), {h, -h}, {h, h}, {-h, h}}) {
    const Geodetic g = geodetic_from_ecef(frame.to_ecef({east_m, north_m, 0.0}));
    const double longitude_rad = middle_rad + wrap_pi(g.longitude_rad - middle_rad);
    corners.push_back({degrees(longitude_rad), degrees(g.latitude_rad)});
  }
  return corners;
}

// The part west (side -1) or east (+1) of a meridian (Sutherland and Hodgman's clipping).
std::vector<Corner> clipped(const std::vector<Corner>& corners, double meridian_deg, int side) {
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner &from = corners[i], &to = corners[(i + 1) % corners.size()];
    const double before = side * (from[0] - meridian_deg), after = side * (to[0] - meridian_deg);
    if (before >= 0.0) kept.push_back(from);
    if (before * after >= 0.0) continue;
    const double share = before / (before - after);
    kept.push_back({meridian_deg, from[1] + share * (to[1] - from[1])});
  }
  return kept;
}

// Closed; a seventh decimal is a centimetre.
json ring_of(std::vector<Corner> corners, double turned_deg) {
  const auto rounded = [](double deg) { return std::round(deg * 1e7) / 1e7; };
  json ring = json::array();
  corners.push_back(corners.front());
  for (const Corner& c : corners) ring.push_back({rounded(c[0] + turned_deg), rounded(c[1])});
  return ring;
}

// A polygon, or one on either side of the date line (RFC 7946, 3.1.9).
json geometry_of(const std::vector<Corner>& corners) {
  for (const double line_deg : {-180.0, 180.0}) {
    const auto west = clipped(corners, line_deg, -1), east = clipped(corners, line_deg, 1);
    if (west.size() < 3 || east.size() < 3) continue;
    const json parts = {{ring_of(west, line_deg < 0.0 ? 360.0 : 0.0)},
                        {ring_of(east, line_deg < 0.0 ? 0.0 : -360.0)}};
    return {{"type", "MultiPolygon"}, {"coordinates", parts}};
  }
  return {{"type", "Polygon"}, {"coordinates", json::array({ring_of(corners, 0.0)})}};
}

json feature_of(const Cell& cell, double spacing_m, double above_m) {
  const Matrix3d& C = *cell.covariance_enu;
  const auto rounded = [](double m) { return std::round(m * 1e4) / 1e4; };
  return {{"type", "Feature"},
          {"geometry", geometry_of(corners_of(cell, spacing_m))},
          {"properties",
           {{"height_m", rounded(cell.centre.height_m)},
            {"above_stations_m", above_m},
            {"east_sd_m", rounded(std::sqrt(C(0, 0)))},
            {"north_sd_m", rounded(std::sqrt(C(1, 1)))},
            {"up_sd_m", rounded(std::sqrt(C(2, 2)))},
            {"horizontal_m", rounded(std::sqrt(C(0, 0) + C(1, 1)))}}}};
}

void require_determined(const std::vector<Cell>& cells, const MapOptions& o, double above_m) {
  const auto known = [](const Cell& cell) { return cell.covariance_enu.has_value(); };
  if (std::ranges::any_of(cells, known)) return;
  std::ostringstream what;
  what << o.stations << ": the stations determine no position " << above_m
       << " m above them: lines of sight of two or more must cross";
  throw std::invalid_argument(what.str());
}

std::vector<Geodetic> places_of(const std::vector<StationRow>& rows) {
  std::vector<Geodetic> places;
  for (const StationRow& row : rows) {
    places.push_back({radians(row.latitude_deg), radians(row.longitude_deg), row.height_m});
  }
  return places;
}

void write_map(const MapOptions& o) {
  check_outputs({{"--stations", o.stations}}, {{"--output", o.output}, {"--geojson", o.geojson}});
  const auto rows = read_stations(o.stations);
  const auto places = places_of(rows);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    require_near(o.stations + ": " + rows[i].station, places[i], {places.front()},
                 "station " + rows.front().station);
  }
  const auto stations = planned_stations(rows, o.measurement);
  const Grid grid = grid_about(rows, o);
  json features = json::array();
  for (const StationRow& row : rows) {
    features.push_back(
        station_feature(row.station, {row.longitude_deg, row.latitude_deg, row.height_m}));
  }
  AtomicFile file(o.output);
  file.stream() << "latitude_deg,longitude_deg,height_m,above_stations_m,east_sd_m,north_sd_m,"
                   "up_sd_m,east_north_m2,east_up_m2,north_up_m2,horizontal_m\n";
  for (const double above_m : o.heights_m) {
    std::ostringstream steps;
    steps << "cells " << above_m << " m above the stations";
    Progress progress("ols-precision", steps.str());
    const auto cells = cells_of(grid, above_m, stations, o.measurement, progress);
    require_determined(cells, o, above_m);
    write_rows(file.stream(), above_m, cells);
    for (const Cell& cell : cells) {
      if (cell.covariance_enu) features.push_back(feature_of(cell, grid.spacing_m, above_m));
    }
  }
  file.commit();
  if (o.geojson.empty()) return;
  AtomicFile geojson(o.geojson);
  geojson.stream() << json{{"type", "FeatureCollection"}, {"features", features}}.dump() << '\n';
  geojson.commit();
}

struct BudgetOptions {
  MeasurementOptions measurement;
  std::string stations, output;
  std::vector<double> at;
};

void write_part(std::ostream& out, const char* name, const Matrix3d& C) {
  out << name << ',' << std::sqrt(C(0, 0)) << ',' << std::sqrt(C(1, 1)) << ',' << std::sqrt(C(2, 2))
      << ',' << std::sqrt(C(0, 0) + C(1, 1)) << '\n';
}

void require_place(const std::vector<double>& at) {
  const auto within = [](double value, double limit) { return std::abs(value) <= limit; };
  if (!within(at[0], 90.0)) throw std::invalid_argument("--at: latitude is outside of +-90");
  if (!within(at[1], 360.0)) throw std::invalid_argument("--at: longitude is outside of +-360");
  if (!within(at[2], 1e6)) throw std::invalid_argument("--at: height is outside of +-1e6");
}

void write_budget(const BudgetOptions& o) {
  check_outputs({{"--stations", o.stations}}, {{"--output", o.output}});
  const auto rows = read_stations(o.stations);
  const auto stations = planned_stations(rows, o.measurement);
  require_place(o.at);
  const Geodetic place{radians(o.at[0]), radians(o.at[1]), o.at[2]};
  require_near("--at", place, places_of(rows), "the stations");
  const auto precision =
      position_precision(stations, planned_target(place, o.measurement), o.measurement.exposures);
  if (!precision) throw std::invalid_argument("--at: the stations do not determine this place");
  const Matrix3d R = R_ecef_enu(place);
  AtomicFile file(o.output);
  std::ostream& out = file.stream();
  out << "source,east_m,north_m,up_m,horizontal_m\n" << std::setprecision(6);
  constexpr std::array kNames{"pixel", "heading", "tilt", "mounting", "position", "clock"};
  static_assert(kNames.size() == kErrorSources.size());
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    write_part(out, kNames.at(i), R.transpose() * precision->parts_ecef.at(i) * R);
  }
  write_part(out, "all", R.transpose() * precision->covariance_ecef * R);
  file.commit();
}

constexpr const char* kStations =
    "CSV: station,latitude_deg,longitude_deg,height_m[,position_sd_m,pointing_sd_deg]";

}  // namespace

void add_map(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("map", "The covariance (1-sigma, metres) of positions over a site.");
  auto o = std::make_shared<MapOptions>();
  command->add_option("--stations", o->stations, kStations)->required();
  command
      ->add_option("--heights", o->heights_m,
                   "[m] above the stations' mean height, one map each: 30,100")
      ->delimiter(',')
      ->check(CLI::Range(-1e4, 1e6))
      ->capture_default_str();
  command->add_option("--margin", o->margin_m, "[m] around the stations; default: half the site")
      ->check(CLI::Range(0.1, 1e7));
  command->add_option("--cells", o->cells, "cells along the longer side")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  command->add_option("--output", o->output, "CSV; tools/precision-plot makes a PNG of it")
      ->required();
  command->add_option("--geojson", o->geojson, "cells and stations for a map program");
  add_measurement_options(*command, o->measurement);
  command->callback([o] { write_map(*o); });
}

void add_budget(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "budget", "What each source of error costs at one place (1-sigma, metres).");
  auto o = std::make_shared<BudgetOptions>();
  command->add_option("--stations", o->stations, kStations)->required();
  command->add_option("--at", o->at, "latitude,longitude in degrees, ellipsoidal height in metres")
      ->required()
      ->delimiter(',')
      ->expected(3);
  command->add_option("--output", o->output, "CSV")->required();
  add_measurement_options(*command, o->measurement);
  command->callback([o] { write_budget(*o); });
}

}  // namespace ols::offline
