#include "tools/calibrate/scenery_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
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

// The pictures of a longer lens are reduced: else they would have details that the other station's
// do not have.
std::vector<scenery::ScenePicture> at_scale(const StationViews& views, double rad_per_px) {
  constexpr double kAlike = 1.2;
  std::vector<scenery::ScenePicture> pictures = views.pictures;
  if (rad_per_px < kAlike * views.rad_per_px) return pictures;
  const double scale = views.rad_per_px / rad_per_px;
  for (scenery::ScenePicture& picture : pictures) {
    cv::Mat1b reduced;
    cv::resize(picture.gray, reduced, {}, scale, scale, cv::INTER_AREA);
    picture.gray = reduced;
    CameraIntrinsics& camera = picture.camera;
    camera.fx_px *= scale;
    camera.fy_px *= scale;
    camera.skew *= scale;
    camera.cx_px = (camera.cx_px + 0.5) * scale - 0.5;
    camera.cy_px = (camera.cy_px + 0.5) * scale - 0.5;
    camera.width_px = reduced.cols;
    camera.height_px = reduced.rows;
  }
  return pictures;
}

ScenePanorama panorama_of(const StationViews& views,
                          const std::vector<scenery::ScenePicture>& pictures, const SceneBox& box,
                          double rad_per_px) {
  ScenePanorama panorama{.rad_per_px = rad_per_px,
                         .centre_ecef = views.camera.origin_ecef(),
                         .R_ecef_enu = views.camera.R_ecef_enu(),
                         .sd = views.sd};
  draw(pictures, box, panorama);
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

// A pillar at a wrong place would hide what stands before it, and one on a slope would be taken for
// something that stands on the slope.
void add(const land::SceneryRow& row, double range_sd_m, const land::Surface& surface,
         MeasuredScenery& scenery) {
  constexpr double kSigmas = 3.0;
  const auto ground = surface.ground(radians(row.latitude_deg), radians(row.longitude_deg));
  if (range_sd_m > 0.5 * land::kSceneryWide_rad * row.range_m) {
    ++scenery.uncertain;
  } else if (!ground || row.height_m - ground->height_m <
                            kSigmas * std::hypot(ground->sd_m, row.height_sd_m)) {
    ++scenery.ground;
  } else {
    scenery.rows.push_back(row);
  }
}

double apart(const StationViews& one, const StationViews& two) {
  return (one.camera.origin_ecef() - two.camera.origin_ecef()).norm();
}

// The mast or the tree beside a station would hide half of its view.
bool is_at_a_station(const land::SceneryRow& row, const std::vector<StationViews>& stations) {
  constexpr double kNear_m = 10.0;
  const Eigen::Vector3d p_ecef =
      ecef_from_geodetic({radians(row.latitude_deg), radians(row.longitude_deg), row.height_m});
  return std::ranges::any_of(stations, [&](const StationViews& station) {
    return station.camera.to_enu(p_ecef).head<2>().norm() < kNear_m;
  });
}

std::vector<StationViews> read_stations(const SceneryOptions& options) {
  constexpr double kLeastApart_m = 5.0;
  if (options.stations.size() < 2) {
    throw std::invalid_argument("--station: two or more stations are needed");
  }
  std::vector<NamedFile> inputs;
  std::vector<StationViews> stations;
  for (const std::string& station : options.stations) {
    inputs.push_back({"--station", config_path(station)});
    stations.push_back(read_views(inputs.back().path));
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      if (apart(stations[i], stations.back()) > kLeastApart_m) continue;
      throw std::invalid_argument(fmt::format("--station: {} and {} are at the same place",
                                              stations[i].station, stations.back().station));
    }
  }
  check_outputs(inputs, {{"--output", options.output}});
  return stations;
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

MeasuredScenery scenery_of(const StationViews& one, const StationViews& two,
                           const land::Surface& surface, const TellSteps& tell) {
  const double apart_m = apart(one, two);
  const double rad_per_px = std::max(one.rad_per_px, two.rad_per_px);
  const auto possible_one = possible(surface, one.camera, apart_m);
  const auto possible_two = possible(surface, two.camera, apart_m);
  const auto pictures_one = at_scale(one, rad_per_px), pictures_two = at_scale(two, rad_per_px);
  const SceneBox seen_one = around(pictures_one), seen_two = around(pictures_two);
  MeasuredScenery scenery;
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
    const ScenePanorama panorama = panorama_of(one, pictures_one, boxes->own, rad_per_px);
    const ScenePanorama there = panorama_of(two, pictures_two, other, rad_per_px);
    for (const auto& range : scenery::scenery_ranges(panorama, there, possible_one, possible_two)) {
      add(row_of(range, panorama, one, two), range.sd_m(), surface, scenery);
    }
  }
  return scenery;
}

CommandReport write_scenery(const SceneryOptions& options, const TellSteps& tell) {
  const auto stations = read_stations(options);
  const auto folder = land::read_terrain_folder(options.land, land::Scenery::kLeftOut);
  std::vector<land::SceneryRow> rows;
  CommandReport report;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    for (std::size_t k = i + 1; k < stations.size(); ++k) {
      const MeasuredScenery found = scenery_of(stations[i], stations[k], *folder.terrain, tell);
      report.summary.push_back(fmt::format(
          "{} and {}: {} points; left out: {} of uncertain range, {} that may be the ground",
          stations[i].station, stations[k].station, found.rows.size(), found.uncertain,
          found.ground));
      rows.insert(rows.end(), found.rows.begin(), found.rows.end());
    }
  }
  std::erase_if(rows, [&](const auto& row) { return is_at_a_station(row, stations); });
  if (rows.empty()) {
    throw std::runtime_error(fmt::format(
        "no scenery was found that two stations see: their sweeps must show the same houses or "
        "trees, and their calibrations must be right ({})",
        fmt::join(report.summary, "; ")));
  }
  land::write_scenery(options.output, rows);
  return report;
}

}  // namespace ols::calibration
