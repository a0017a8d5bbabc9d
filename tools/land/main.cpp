// ols-land: imports the land around a site, shows what it hides, and finds the direction of a
// photograph by it.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "base/files/atomic_file.h"
#include "base/process/command_line.h"
#include "geometry/angles.h"
#include "land/horizon_map.h"
#include "land/terrain_folder.h"
#include "tools/land/heading_command.h"
#include "tools/land/land_import.h"

namespace {

using namespace ols;

struct View {
  std::string folder, output;
  std::vector<double> at;
  double reach_km = 30.0;
  double azimuth_deg = 0.0;
};

land::TerrainFolder open(const View& view) {
  if (std::abs(view.at[0]) > 90.0 || std::abs(view.at[1]) > 180.0) {
    throw std::invalid_argument("--at: is no latitude and longitude");
  }
  return land::read_terrain_folder(view.folder);
}

Geodetic camera_of(const View& view) {
  return {radians(view.at[0]), radians(view.at[1]), view.at[2]};
}

land::HorizonMap map_of(const View& view, const land::Terrain& terrain, double sector_rad) {
  land::HorizonMap map(terrain, camera_of(view),
                       {.reach_m = 1000.0 * view.reach_km,
                        .from_azimuth_rad = radians(view.azimuth_deg) - 0.5 * sector_rad,
                        .sector_rad = sector_rad});
  if (map.lowered_m() > 0.0) {
    std::cerr << "ols-land: the model's ground is lowered by " << map.lowered_m()
              << " m at the camera, within its error\n";
  }
  return map;
}

void write_horizon(const View& view) {
  const land::TerrainFolder folder = open(view);
  const land::HorizonMap map = map_of(view, *folder.terrain, 2.0 * kPi);
  AtomicFile file(view.output);
  std::ostream& out = file.stream();
  out << "azimuth_deg,elevation_deg,elevation_sd_deg,distance_m,known_to_m\n" << std::fixed;
  const int columns = map.config().columns;
  for (int column = 0; column < columns; ++column) {
    const double azimuth_rad = 2.0 * kPi * column / columns;
    out << std::setprecision(2) << degrees(azimuth_rad);
    const auto skyline = map.skyline(azimuth_rad);
    out << std::setprecision(4);
    if (skyline) {
      out << ',' << degrees(skyline->elevation_rad) << ',' << degrees(skyline->elevation_sd_rad);
      out << std::setprecision(0) << ',' << skyline->distance_m;
    } else {
      out << ",,,";
    }
    out << std::setprecision(0) << ',' << map.known_to_m(azimuth_rad) << '\n';
  }
  file.commit();
}

void write_profile(const View& view, double step_m, std::optional<double> elevation_deg) {
  const land::TerrainFolder folder = open(view);
  const land::HorizonMap map = map_of(view, *folder.terrain, radians(0.2));
  const double azimuth_rad = radians(view.azimuth_deg);
  AtomicFile file(view.output);
  std::ostream& out = file.stream();
  out << "distance_m,latitude_deg,longitude_deg,ground_m,top_m,hidden_below_deg\n" << std::fixed;
  const LocalFrame frame(camera_of(view));
  for (double d = step_m; d <= map.config().reach_m; d += step_m) {
    const Geodetic place = geodetic_from_ecef(
        frame.to_ecef({d * std::sin(azimuth_rad), d * std::cos(azimuth_rad), 0.0}));
    const auto ground = folder.terrain->ground(place.latitude_rad, place.longitude_rad);
    const auto top = folder.terrain->top(place.latitude_rad, place.longitude_rad);
    const auto hidden = map.highest_before(azimuth_rad, d);
    out << std::setprecision(1) << d << std::setprecision(7) << ',' << degrees(place.latitude_rad)
        << ',' << degrees(place.longitude_rad) << std::setprecision(1) << ',';
    if (ground) out << ground->height_m;
    out << ',';
    if (top) out << top->height_m;
    out << ',' << std::setprecision(4);
    if (hidden) out << degrees(hidden->elevation_rad);
    out << '\n';
  }
  file.commit();
  if (!elevation_deg) return;
  const auto hit = map.ground({azimuth_rad, radians(*elevation_deg)});
  if (hit) {
    std::cout << "the line of sight meets the land at " << std::lround(hit->range_m) << " m\n";
  } else {
    std::cout << "the line of sight meets no land within " << view.reach_km << " km\n";
  }
}

void add_import(CLI::App& app, land::ImportOptions& o, std::vector<double>& site) {
  auto* command = app.add_subcommand("import", "Make the folder of a site's land");
  command->add_option("--site", site, "latitude,longitude of the site in degrees")
      ->required()
      ->delimiter(',')
      ->expected(2);
  command->add_option("--radius-km", o.radius_km, "Land is imported so far around")
      ->check(CLI::Range(1.0, 300.0))
      ->capture_default_str();
  command->add_option("--elevation", o.elevation, "Elevation models: any files that GDAL reads")
      ->required();
  command->add_option("--heights", o.heights,
                      "What the models' heights are above: a geoid's grid for PROJ, or ellipsoid; "
                      "SRTM and DTED say it themselves (egm96_15.gtx)");
  command->add_option("--sd", o.sd_m, "1-sigma of the models' heights in metres")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--buildings", o.buildings,
                      "Outlines of buildings with height or building:levels (GeoJSON, OSM, ...)");
  command->add_option("--woods", o.woods, "Outlines of woods with height");
  command->add_option("--scenery", o.scenery,
                      "What ols-calibrate scenery has measured; several files");
  command->add_option("--licence", o.licence, "Licence of the data, kept in the folder");
  command->add_flag("--accept-seams", o.accept_seams, "Take models that do not join as they are");
  command->add_option("--output", o.output, "Folder to make")->required();
}

// In degrees and percent, as they are given.
struct HeadingView {
  std::vector<double> at;
  std::optional<double> heading_deg;
  double heading_sd_deg = 5.0, tilt_deg = 0.0, tilt_sd_deg = 8.0, roll_deg = 0.0, roll_sd_deg = 2.0;
  double focal_sd_percent = 1.0, reach_km = 60.0;
};

CLI::App* add_heading(CLI::App& app, land::HeadingOptions& o, HeadingView& view) {
  o.camera.fy_px = o.camera.cx_px = o.camera.cy_px = std::nan("");
  o.position_sd_m = 5.0;
  o.prior.k1_sd = 0.02;
  const CLI::Range sd(0.001, 90.0);
  auto* command = app.add_subcommand("heading", "The direction of a photograph, by its skyline");
  command->add_option("folder", o.folder, "Folder of ols-land import")->required();
  command->add_option("--picture", o.picture, "By day, sky above")->required();
  command
      ->add_option("--at", view.at,
                   "Camera: latitude,longitude in degrees, ellipsoidal height in metres")
      ->required()
      ->delimiter(',')
      ->expected(3);
  command->add_option("--position-sd", o.position_sd_m, "1-sigma of it in metres")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command->add_option("--fx", o.camera.fx_px, "Focal length in pixels of the picture")
      ->required()
      ->check(CLI::Range(10.0, 1e6));
  command->add_option("--fy", o.camera.fy_px, "The same vertically; without it as --fx")
      ->check(CLI::Range(10.0, 1e6));
  command->add_option("--fx-sd", view.focal_sd_percent, "1-sigma of both in percent")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--cx", o.camera.cx_px, "Principal point; without it the middle");
  command->add_option("--cy", o.camera.cy_px, "The same vertically");
  command->add_option("--k1", o.camera.k1, "Radial distortion, as OpenCV has it");
  command->add_option("--k1-sd", o.prior.k1_sd, "1-sigma of it")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--k2", o.camera.k2);
  command->add_option("--heading", view.heading_deg,
                      "About, in degrees from true north; without it all around is searched");
  command->add_option("--heading-sd", view.heading_sd_deg, "1-sigma of it")
      ->check(sd)
      ->capture_default_str();
  command->add_option("--tilt", view.tilt_deg, "Elevation of the optical axis, about")
      ->check(CLI::Range(-60.0, 60.0))
      ->capture_default_str();
  command->add_option("--tilt-sd", view.tilt_sd_deg, "1-sigma of it")
      ->check(CLI::Range(0.001, 20.0))
      ->capture_default_str();
  command->add_option("--roll", view.roll_deg, "About; positive: the picture's right side is low")
      ->check(CLI::Range(-45.0, 45.0))
      ->capture_default_str();
  command->add_option("--roll-sd", view.roll_sd_deg, "1-sigma of it")
      ->check(CLI::Range(0.001, 15.0))
      ->capture_default_str();
  command->add_option("--reach-km", view.reach_km, "How far to look")
      ->check(CLI::Range(0.1, 200.0))
      ->capture_default_str();
  return command;
}

int print_heading(land::HeadingOptions options, const HeadingView& view) {
  if (std::abs(view.at[0]) > 90.0 || std::abs(view.at[1]) > 180.0) {
    throw std::invalid_argument("--at: is no latitude and longitude");
  }
  options.at = {radians(view.at[0]), radians(view.at[1]), view.at[2]};
  options.reach_m = 1000.0 * view.reach_km;
  if (view.heading_deg) options.prior.heading_rad = radians(*view.heading_deg);
  options.prior.heading_sd_rad = radians(view.heading_sd_deg);
  options.prior.tilt_rad = radians(view.tilt_deg);
  options.prior.tilt_sd_rad = radians(view.tilt_sd_deg);
  options.prior.roll_rad = radians(view.roll_deg);
  options.prior.roll_sd_rad = radians(view.roll_sd_deg);
  options.prior.focal_sd = 0.01 * view.focal_sd_percent;
  return land::print_heading(std::move(options));
}

CLI::App* add_view(CLI::App& app, const char* name, const char* about, View& view) {
  auto* command = app.add_subcommand(name, about);
  command->add_option("folder", view.folder, "Folder of ols-land import")->required();
  command
      ->add_option("--at", view.at,
                   "Camera: latitude,longitude in degrees, ellipsoidal height in metres")
      ->required()
      ->delimiter(',')
      ->expected(3);
  command->add_option("--reach-km", view.reach_km, "How far to look")
      ->check(CLI::Range(0.1, 200.0))
      ->capture_default_str();
  command->add_option("--output", view.output, "CSV")->required();
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  remove_temporary_files_on_signals();
  CLI::App app{"The land around a site: imports it, and shows what it hides (docs/land.md)"};
  app.set_version_flag("--version", OLS_VERSION);
  app.require_subcommand(1);
  land::ImportOptions options;
  std::vector<double> site;
  View view;
  double step_m = 10.0;
  std::optional<double> elevation_deg;
  add_import(app, options, site);
  auto* horizon = add_view(app, "horizon", "The skyline of a camera, by azimuth", view);
  land::HeadingOptions heading_options;
  HeadingView heading_view;
  auto* heading = add_heading(app, heading_options, heading_view);
  auto* profile = add_view(app, "profile", "The land along one azimuth of a camera", view);
  profile->add_option("--azimuth", view.azimuth_deg, "Clockwise from true north, in degrees")
      ->required();
  profile->add_option("--elevation", elevation_deg,
                      "Elevation of a line of sight in degrees: says where it meets the land");
  profile->add_option("--step", step_m, "Metres between rows")
      ->check(CLI::Range(0.1, 10'000.0))
      ->capture_default_str();
  return run_command(app, argc, argv, "ols-land", [&] {
    if (*heading) return print_heading(heading_options, heading_view);
    if (*horizon) {
      write_horizon(view);
    } else if (*profile) {
      write_profile(view, step_m, elevation_deg);
    } else {
      if (std::abs(site[0]) > 85.0 || std::abs(site[1]) > 180.0) {
        throw std::invalid_argument("--site: is no latitude and longitude");
      }
      options.latitude_deg = site[0];
      options.longitude_deg = site[1];
      for (const std::string& note : land::import_land(options)) std::cout << note << '\n';
    }
    return 0;
  });
}
