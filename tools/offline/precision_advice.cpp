// ols-precision advise: the best of many places for some stations.
#include <iomanip>
#include <iostream>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/progress.h"
#include "geometry/angles.h"
#include "geometry/placement.h"
#include "tools/offline/geojson.h"
#include "tools/offline/near_place.h"
#include "tools/offline/precision_options.h"
#include "tools/offline/precision_site_files.h"

namespace ols::offline {
namespace {

struct AdviceOptions {
  MeasurementOptions measurement;
  std::string places, area, kept, output;
  std::size_t stations = 3;
  std::vector<double> heights_m = {50.0};
  double ground_m = 0.0;
  double spacing_m = 0.0;
  double place_spacing_m = 0.0;
  bool mean = false;
  std::uint64_t seed = 1;
};

bool is_geojson(const std::string& path) {
  return path.ends_with(".json") || path.ends_with(".geojson");
}

// Missing or duplicate names get a number.
std::string free_name(const std::string& wanted, std::set<std::string>& taken) {
  std::string name = wanted;
  for (int i = 1; name.empty() || taken.contains(name); ++i) {
    name = (wanted.empty() ? "place" : wanted) + "-" + std::to_string(i);
  }
  taken.insert(name);
  return name;
}

StationRow row_of(const std::string& name, const Geodetic& place) {
  StationRow row;
  row.station = name;
  row.latitude_deg = degrees(place.latitude_rad);
  row.longitude_deg = degrees(place.longitude_rad);
  row.height_m = place.height_m;
  return row;
}

std::vector<StationRow> read_places(const AdviceOptions& o) {
  if (!is_geojson(o.places)) return read_stations(o.places);
  const GeoShapes shapes = read_geojson(o.places);
  std::vector<StationRow> rows;
  std::set<std::string> taken;
  for (const GeoPoint& point : shapes.points) {
    const GeoPosition& p = point.position;
    rows.push_back(row_of(
        free_name(point.name, taken),
        {radians(p.latitude_deg), radians(p.longitude_deg), p.height_m.value_or(o.ground_m)}));
  }
  if (!shapes.polygons.empty() && !(o.place_spacing_m > 0.0)) {
    throw std::invalid_argument(o.places + ": has polygons, which need --place-spacing");
  }
  for (const Geodetic& place : fill(shapes.polygons, o.place_spacing_m, o.ground_m)) {
    rows.push_back(row_of(free_name("", taken), place));
  }
  return rows;
}

void require_all_near(const std::string& file, const std::vector<StationRow>& rows,
                      const GeoShapes& area) {
  std::vector<Geodetic> corners;
  for (const GeoPolygon& polygon : area.polygons) {
    for (const GeoPosition& p : polygon.front()) {
      corners.push_back({radians(p.latitude_deg), radians(p.longitude_deg), 0.0});
    }
  }
  for (const StationRow& row : rows) {
    require_near(file + ": " + row.station,
                 {radians(row.latitude_deg), radians(row.longitude_deg), row.height_m}, corners,
                 "the area");
  }
}

// The area at each height: a grid inside and the corners of its outline.
std::vector<PlannedTarget> area_of(const AdviceOptions& o, const GeoShapes& shapes) {
  std::vector<PlannedTarget> area;
  for (const double above_m : o.heights_m) {
    const double height_m = o.ground_m + above_m;
    for (const Geodetic& place : fill(shapes.polygons, o.spacing_m, height_m)) {
      area.push_back(planned_target(place, o.measurement));
    }
    for (const GeoPolygon& polygon : shapes.polygons) {
      for (std::size_t i = 1; i < polygon.front().size(); ++i) {
        const GeoPosition& p = polygon.front()[i];
        area.push_back(planned_target({radians(p.latitude_deg), radians(p.longitude_deg), height_m},
                                      o.measurement));
      }
    }
  }
  return area;
}

void write_advice(const AdviceOptions& o) {
  check_outputs({{"--places", o.places}, {"--area", o.area}, {"--kept", o.kept}},
                {{"--output", o.output}});
  const auto rows = read_places(o);
  const GeoShapes area = read_geojson(o.area);
  if (area.polygons.empty()) throw std::invalid_argument(o.area + ": has no polygon");
  require_all_near(o.places, rows, area);
  PlacementProblem problem;
  problem.places = planned_stations(rows, o.measurement);
  if (!o.kept.empty()) {
    const auto kept = read_stations(o.kept);
    require_all_near(o.kept, kept, area);
    problem.kept = planned_stations(kept, o.measurement);
  }
  problem.area = area_of(o, area);
  problem.stations = o.stations;
  problem.goal = o.mean ? PlacementGoal::kMean : PlacementGoal::kWorst;
  problem.exposures = o.measurement.exposures;
  std::mt19937_64 generator(o.seed);
  const Placement placement =
      place_stations(problem, generator, Progress("ols-precision", "searches"));
  AtomicFile file(o.output);
  file.stream() << "station,latitude_deg,longitude_deg,height_m\n" << std::setprecision(10);
  for (const std::size_t chosen : placement.chosen) {
    const StationRow& row = rows[chosen];
    file.stream() << row.station << ',' << row.latitude_deg << ',' << row.longitude_deg << ','
                  << row.height_m << '\n';
  }
  file.commit();
  if (!placement.determines_all()) {
    std::cout << "a part of the area stays undetermined: no two of the stations see it cross\n";
    return;
  }
  std::cout << std::setprecision(4) << "3-D error over the area, root mean square: mean "
            << placement.mean_m << " m, worst " << placement.worst_m << " m\n";
}

}  // namespace

void add_advice(CLI::App& app) {
  CLI::App* command = app.add_subcommand("advise", "Where to put stations to protect an area.");
  auto o = std::make_shared<AdviceOptions>();
  command
      ->add_option("--places", o->places,
                   "that can be used: CSV as stations.csv, or GeoJSON with points or polygons")
      ->required();
  command->add_option("--area", o->area, "to protect: GeoJSON with a polygon")->required();
  command->add_option("--stations", o->stations, "how many to place")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--kept", o->kept, "existing stations: stations.csv");
  command->add_option("--heights", o->heights_m, "[m] of targets above the ground")
      ->delimiter(',')
      ->check(CLI::Range(-1e4, 1e6))
      ->capture_default_str();
  command->add_option("--ground", o->ground_m, "[m] ellipsoidal height of the ground")
      ->required()
      ->check(CLI::Range(-1e4, 1e5));
  command->add_option("--spacing", o->spacing_m, "[m] of the points that stand for the area")
      ->required()
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--place-spacing", o->place_spacing_m, "[m] of places inside polygons")
      ->check(CLI::Range(0.1, 1e6));
  command->add_flag("--mean", o->mean,
                    "minimise the mean error over the area instead of the worst point's");
  command->add_option("--seed", o->seed, "of the search")->capture_default_str();
  command->add_option("--output", o->output, "CSV as stations.csv: the places to use")->required();
  add_measurement_options(*command, o->measurement);
  command->callback([o] { write_advice(*o); });
}

}  // namespace ols::offline
