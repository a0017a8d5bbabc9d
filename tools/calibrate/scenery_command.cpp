#include "tools/calibrate/scenery_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/files/output_check.h"
#include "geometry/angles.h"
#include "land/scenery/scenery_ranges.h"
#include "land/terrain_folder.h"
#include "tools/calibrate/config_change.h"

namespace ols::calibration {
namespace {

using scenery::SceneBox;
using scenery::ScenePanorama;

constexpr int kSectors = 12;

scenery::PossibleRanges possible(const land::Surface& surface, const LocalFrame& camera,
                                 double apart_m) {
  constexpr double kNearest = 0.6, kFarthest = 12.0;
  const scenery::RangeInterval within{kNearest * apart_m, kFarthest * apart_m};
  return [&surface, camera, within](const AzimuthElevation& direction) {
    return scenery::possible_ranges(surface, camera, direction, within);
  };
}

ScenePanorama panorama_of(const StationViews& views, const SceneBox& box, double rad_per_px) {
  ScenePanorama panorama{.rad_per_px = rad_per_px,
                         .centre_ecef = views.camera.origin_ecef(),
                         .R_ecef_enu = views.camera.R_ecef_enu(),
                         .sd = views.sd};
  draw(views.pictures, box, panorama);
  return panorama;
}

land::SceneryRow row_of(const scenery::SceneryRange& range, const ScenePanorama& panorama,
                        const StationViews& one, const StationViews& two) {
  const Geodetic place = geodetic_from_ecef(scenery::point_ecef(panorama, range.px, range.range_m));
  const double height_sd_m =
      std::hypot(range.range_m * one.sd.tilt_rad, one.sd.position_m,
                 std::abs(std::sin(range.direction.elevation_rad)) * range.sd_m());
  return {one.station,
          two.station,
          degrees(place.latitude_rad),
          degrees(place.longitude_rad),
          place.height_m,
          height_sd_m,
          degrees(range.direction.azimuth_rad),
          degrees(range.direction.elevation_rad),
          range.range_m,
          range.sd_white_m,
          range.sd_systematic_m};
}

void check(const SceneryOptions& options) {
  if (options.stations.size() < 2) {
    throw std::invalid_argument("--station: two or more stations are needed");
  }
  std::vector<NamedFile> inputs;
  for (const std::string& station : options.stations) {
    inputs.push_back({"--station", config_path(station)});
  }
  check_outputs(inputs, {{"--output", options.output}});
}

}  // namespace

CLI::App* add_scenery(CLI::App& app, SceneryOptions& o) {
  CLI::App* command = app.add_subcommand(
      "scenery",
      "Where the scenery stands, from the pictures of the sweeps of two or more stations: houses, "
      "trees and slopes that the land's folder does not have. Takes minutes. `ols-land import "
      "--scenery` takes the result.");
  command
      ->add_option("--station", o.stations,
                   "its configuration, or its name (/etc/ols/NAME.toml); two or more")
      ->required();
  command->add_option("--land", o.land, "folder of ols-land import")->required();
  command->add_option("--output", o.output, "CSV")->required();
  return command;
}

std::vector<land::SceneryRow> scenery_of(const StationViews& one, const StationViews& two,
                                         const land::Surface& surface, const TellSteps& tell) {
  const double apart_m = (one.camera.origin_ecef() - two.camera.origin_ecef()).norm();
  const double rad_per_px = std::max(one.rad_per_px, two.rad_per_px);
  const auto possible_one = possible(surface, one.camera, apart_m);
  const auto possible_two = possible(surface, two.camera, apart_m);
  const SceneBox seen_one = around(one.pictures), seen_two = around(two.pictures);
  std::vector<land::SceneryRow> rows;
  for (int i = 0; i < kSectors; ++i) {
    tell(static_cast<std::size_t>(i), kSectors);
    const double width_rad = 2.0 * kPi / kSectors;
    const SceneBox sector{i * width_rad, width_rad, seen_one.bottom_rad, seen_one.top_rad};
    auto boxes = scenery::shared_boxes(sector, one.camera, two.camera, possible_one);
    if (!boxes) continue;
    SceneBox& other = boxes->other;
    other.bottom_rad = std::max(other.bottom_rad, seen_two.bottom_rad);
    other.top_rad = std::min(other.top_rad, seen_two.top_rad);
    if (other.bottom_rad >= other.top_rad) continue;
    const ScenePanorama panorama = panorama_of(one, boxes->own, rad_per_px);
    const ScenePanorama there = panorama_of(two, other, rad_per_px);
    for (const auto& range : scenery::scenery_ranges(panorama, there, possible_one, possible_two)) {
      rows.push_back(row_of(range, panorama, one, two));
    }
  }
  return rows;
}

CommandReport write_scenery(const SceneryOptions& options, const TellSteps& tell) {
  check(options);
  const auto folder = land::read_terrain_folder(options.land, land::Scenery::kLeftOut);
  std::vector<StationViews> stations;
  for (const std::string& station : options.stations) {
    stations.push_back(read_views(config_path(station)));
  }
  std::vector<land::SceneryRow> rows;
  CommandReport report;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    for (std::size_t k = i + 1; k < stations.size(); ++k) {
      const auto found = scenery_of(stations[i], stations[k], *folder.terrain, tell);
      report.summary.push_back(fmt::format("{} and {}: {} points", stations[i].station,
                                           stations[k].station, found.size()));
      rows.insert(rows.end(), found.begin(), found.end());
    }
  }
  if (rows.empty()) {
    throw std::runtime_error(
        "no scenery was found that two stations see: their sweeps must show the same houses, trees "
        "or slopes, and their calibrations must be right");
  }
  land::write_scenery(options.output, rows);
  return report;
}

}  // namespace ols::calibration
