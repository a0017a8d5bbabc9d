// ols-precision advise: the best of many places for some stations.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
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
#include "tools/offline/planned_land.h"
#include "tools/offline/precision_options.h"
#include "tools/offline/precision_site_files.h"

namespace ols::offline {
namespace {

struct AdviceOptions {
  MeasurementOptions measurement;
  std::string places, area, kept, land, output;
  std::size_t stations = 3;
  std::vector<double> heights_m = {50.0};
  std::optional<double> ground_m;
  double mast_m = 2.0;
  double spacing_m = 0.0;
  double place_spacing_m = 0.0;
  double within_m = std::numeric_limits<double>::infinity();
  bool mean = false;
  std::uint64_t seed = 1;
};

// The ground of the site: its land, or one height everywhere.
class Ground {
 public:
  explicit Ground(const AdviceOptions& o)
      : level_m_(o.ground_m), mast_m_(o.land.empty() ? 0.0 : o.mast_m) {
    if (o.land.empty() == !o.ground_m)
      throw std::invalid_argument("give either --ground or --land");
    if (!o.land.empty()) land_.emplace(o.land);
  }

  // Ellipsoidal; nothing where the land is not known.
  std::optional<double> at(const Geodetic& place) const {
    return land_ ? land_->ground_m(place) : level_m_;
  }
  // The ellipsoidal height of a camera that stands there.
  std::optional<double> camera_m(const Geodetic& place) const {
    const auto ground_m = at(place);
    return ground_m ? std::optional(*ground_m + mast_m_) : std::nullopt;
  }
  // Makes the land hide some of the targets from the station.
  void hide(const std::string& name, const std::vector<PlannedTarget>& area,
            PlannedStation& station) const {
    if (!land_) return;
    double farthest_m = 0.0;
    for (const PlannedTarget& target : area) {
      farthest_m = std::max(farthest_m, (target.p_ecef - station.place.origin_ecef()).norm());
    }
    hide_behind(land_->look(name, station.place.origin(), farthest_m), station);
  }

 private:
  std::optional<PlannedLand> land_;
  std::optional<double> level_m_;
  double mast_m_;
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

std::vector<StationRow> read_places(const AdviceOptions& o, const Ground& ground) {
  if (!is_geojson(o.places)) return read_stations(o.places);
  const GeoShapes shapes = read_geojson(o.places);
  std::vector<StationRow> rows;
  std::set<std::string> taken;
  for (const GeoPoint& point : shapes.points) {
    const GeoPosition& p = point.position;
    Geodetic place{radians(p.latitude_deg), radians(p.longitude_deg), 0.0};
    const std::string name = free_name(point.name, taken);
    const auto height_m = p.height_m ? p.height_m : ground.camera_m(place);
    if (!height_m) {
      throw std::invalid_argument(o.places + ": " + name + ": its ground is not known in " +
                                  o.land);
    }
    place.height_m = *height_m;
    rows.push_back(row_of(name, place));
  }
  if (!shapes.polygons.empty() && !(o.place_spacing_m > 0.0)) {
    throw std::invalid_argument(o.places + ": has polygons, which need --place-spacing");
  }
  for (Geodetic place : fill(shapes.polygons, o.place_spacing_m, 0.0)) {
    const auto height_m = ground.camera_m(place);
    if (!height_m) continue;  // the sea, or a void: nobody would stand there
    place.height_m = *height_m;
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

// A grid inside the area and the corners of its outline, at no height yet.
std::vector<Geodetic> points_of(const GeoShapes& area, double spacing_m) {
  std::vector<Geodetic> points = fill(area.polygons, spacing_m, 0.0);
  for (const GeoPolygon& polygon : area.polygons) {
    for (std::size_t i = 1; i < polygon.front().size(); ++i) {
      const GeoPosition& p = polygon.front()[i];
      points.push_back({radians(p.latitude_deg), radians(p.longitude_deg), 0.0});
    }
  }
  return points;
}

// At each height above the ground, where that is known.
std::vector<PlannedTarget> targets_over(const std::vector<Geodetic>& points, const Ground& ground,
                                        const AdviceOptions& o) {
  std::vector<PlannedTarget> targets;
  std::size_t unknown = 0;
  for (Geodetic point : points) {
    const auto ground_m = ground.at(point);
    unknown += ground_m ? 0 : 1;
    for (const double above_m : o.heights_m) {
      if (!ground_m) continue;
      point.height_m = *ground_m + above_m;
      targets.push_back(planned_target(point, o.measurement));
    }
  }
  if (unknown > 0) {
    std::cerr << "ols-precision: " << o.land << " does not know the ground below " << unknown
              << " of " << points.size() << " points of the area: left out\n";
  }
  return targets;
}

std::vector<PlannedStation> seeing(const std::string& file, const std::vector<StationRow>& rows,
                                   const std::vector<PlannedTarget>& targets, const Ground& ground,
                                   const MeasurementOptions& measurement) {
  std::vector<PlannedStation> stations = planned_stations(rows, measurement);
  Progress progress("ols-precision", "views");
  for (std::size_t i = 0; i < stations.size(); ++i) {
    progress(i, stations.size());
    ground.hide(file + ": " + rows[i].station, targets, stations[i]);
  }
  return stations;
}

void tell(const Placement& placement, std::size_t points, double within_m) {
  if (placement.undetermined > 0) {
    std::cout << placement.undetermined << " of " << points
              << " points of the area stay undetermined: no two of the stations see them cross";
    if (std::isfinite(within_m)) std::cout << ", or the error is above " << within_m << " m";
    std::cout << '\n';
  }
  if (placement.undetermined == points) return;
  std::cout << std::setprecision(4) << "3-D error over the "
            << (placement.undetermined > 0 ? "others" : "area") << ", root mean square: mean "
            << placement.mean_m << " m, worst " << placement.worst_m << " m\n";
}

void write_advice(const AdviceOptions& o) {
  check_outputs({{"--places", o.places}, {"--area", o.area}, {"--kept", o.kept}},
                {{"--output", o.output}});
  const Ground ground(o);
  const auto rows = read_places(o, ground);
  const GeoShapes area = read_geojson(o.area);
  if (area.polygons.empty()) throw std::invalid_argument(o.area + ": has no polygon");
  require_all_near(o.places, rows, area);
  PlacementProblem problem;
  problem.area = targets_over(points_of(area, o.spacing_m), ground, o);
  problem.places = seeing(o.places, rows, problem.area, ground, o.measurement);
  if (!o.kept.empty()) {
    const auto kept = read_stations(o.kept);
    require_all_near(o.kept, kept, area);
    problem.kept = seeing(o.kept, kept, problem.area, ground, o.measurement);
  }
  problem.stations = o.stations;
  problem.within_m = o.within_m;
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
  tell(placement, problem.area.size(), o.within_m);
}

}  // namespace

void add_advice(CLI::App& app) {
  CLI::App* command = app.add_subcommand("advise", "Where to put stations to protect an area.");
  auto o = std::make_shared<AdviceOptions>();
  command
      ->add_option("--places", o->places,
                   "usable places: CSV as stations.csv, or GeoJSON with points or polygons")
      ->required();
  command->add_option("--area", o->area, "area to protect: GeoJSON with a polygon")->required();
  command->add_option("--stations", o->stations, "how many to place")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--kept", o->kept, "existing stations: stations.csv");
  command->add_option("--heights", o->heights_m, "[m] of targets above the ground")
      ->delimiter(',')
      ->check(CLI::Range(-1e4, 1e6))
      ->capture_default_str();
  command->add_option("--ground", o->ground_m, "[m] ellipsoidal height of level ground")
      ->check(CLI::Range(-1e4, 1e5));
  command->add_option("--land", o->land,
                      "folder of ols-land import: ground, and what it hides, instead of --ground");
  command
      ->add_option("--mast", o->mast_m,
                   "[m] of a camera above the land, at places without a height")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command->add_option("--spacing", o->spacing_m, "[m] of the points that stand for the area")
      ->required()
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--place-spacing", o->place_spacing_m, "[m] of places inside polygons")
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--within", o->within_m, "[m] a point with a larger error is undetermined")
      ->check(CLI::Range(1e-3, 1e6));
  command->add_flag("--mean", o->mean,
                    "minimise the mean error over the area instead of the worst point's");
  command->add_option("--seed", o->seed, "seed of the search")->capture_default_str();
  command->add_option("--output", o->output, "CSV as stations.csv: the places to use")->required();
  add_measurement_options(*command, o->measurement);
  command->callback([o] { write_advice(*o); });
}

}  // namespace ols::offline
