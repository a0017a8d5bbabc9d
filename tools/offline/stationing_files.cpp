#include "tools/offline/stationing_files.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <stdexcept>

#include "base/csv_files.h"
#include "geometry/angles.h"
#include "geometry/utm.h"

namespace ols {
namespace {

Geodetic place_of(const SurveyRow& point, const std::string& path) {
  if (const auto* place = std::get_if<GeodeticCells>(&point.place)) {
    return {radians(place->latitude_deg), radians(place->longitude_deg), point.height_m};
  }
  const auto& utm = std::get<UtmCells>(point.place);
  try {
    return geodetic_from_utm({utm.zone, utm.northern, utm.easting_m, utm.northing_m},
                             point.height_m);
  } catch (const std::invalid_argument& error) {
    throw CsvError(path + ":" + std::to_string(point.line) + ": easting_m: " + error.what());
  }
}

const SurveyRow& named(const std::vector<SurveyRow>& survey, const std::string& name) {
  return *std::ranges::find(survey, name, &SurveyRow::landmark);
}

// What is known before a landmark is sighted: where the station stands, and how level.
StationGeometry rough_station(const StationingOptions& options, const StationSettings& settings,
                              const std::vector<SurveyRow>& survey) {
  StationGeometry rough = settings.station.geometry;
  if (!settings.pose.surveyed_tilt_rad) rough.sd.tilt_rad = settings.pose.level_sd_rad;
  if (!options.at.empty()) {
    if (std::ranges::find(survey, options.at, &SurveyRow::landmark) == survey.end()) {
      throw std::invalid_argument("--at: '" + options.at + "' is not in " + options.landmarks);
    }
    const SurveyRow& point = named(survey, options.at);
    rough.position = place_of(point, options.landmarks);
    rough.sd.position_m = point.sd_m;
  } else if (!settings.pose.surveyed_position) {
    throw std::invalid_argument(options.station +
                                ": pose.latitude_deg: is needed, or --at a landmark");
  }
  return rough;
}

LandmarkSighting sighting_of(const SightedRow& row, const SurveyRow& point,
                             const CameraIntrinsics& camera, const StationingOptions& options) {
  LandmarkSighting sighting;
  sighting.landmark_ecef = ecef_from_geodetic(place_of(point, options.landmarks));
  sighting.landmark_sd_m = point.sd_m;
  sighting.pixel = {row.x_px.value_or(camera.cx_px), row.y_px.value_or(camera.cy_px)};
  sighting.pixel_sd_px = options.pixel_sd_px;
  sighting.angles = {radians(row.pan_deg), radians(row.tilt_deg)};
  sighting.angles_sd_rad = radians(options.angles_sd_deg);
  return sighting;
}

void write_residuals(std::ostream& out, const StationingCase& before, const Stationing& found) {
  constexpr double kStandsOut = 4.0;
  out << std::setprecision(1) << "# Each sighting's residual over its deviation, across and up:\n";
  for (std::size_t i = 0; i < before.names.size(); ++i) {
    const Eigen::Vector2d& off = found.residuals[i];
    out << "#   " << before.names[i] << ": " << off.x() << ' ' << off.y();
    if (off.norm() > kStandsOut) out << "  stands out: another landmark, or misread?";
    out << '\n';
  }
}

}  // namespace

StationingCase read_stationing(const StationingOptions& options) {
  StationingCase result;
  result.settings = load_station_settings(options.station);
  const auto survey = read_survey(options.landmarks);
  result.rough = rough_station(options, result.settings, survey);
  for (const SightedRow& row : read_sighted(options.sightings, survey)) {
    if (row.landmark == options.at) {
      throw CsvError(options.sightings + ":" + std::to_string(row.line) +
                     ": landmark: the station stands at it");
    }
    result.names.push_back(row.landmark);
    result.sightings.push_back(
        sighting_of(row, named(survey, row.landmark), result.rough.camera, options));
  }
  return result;
}

void write_stationing(std::ostream& out, const StationingCase& before, const Stationing& found,
                      bool with_position) {
  const StationGeometry& station = found.station;
  const auto line = [&out](const char* key, double value, int digits) {
    out << key << " = " << std::setprecision(digits) << value << '\n';
  };
  const auto angle = [&](const char* key, double rad) { line(key, degrees(rad), 5); };
  out << std::fixed << "# Station " << before.settings.id << " by " << before.names.size()
      << " sightings of landmarks.\n";
  write_residuals(out, before, found);
  out << "\n[pose]\n";
  if (with_position) {
    line("latitude_deg", degrees(station.position.latitude_rad), 9);
    line("longitude_deg", degrees(station.position.longitude_rad), 9);
    line("height_m", station.position.height_m, 3);
  }
  angle("heading_deg", station.chain.heading_rad);
  angle("tilt_x_deg", station.chain.tilt_x_rad);
  angle("tilt_y_deg", station.chain.tilt_y_rad);
  out << "\n[chain]\n";
  angle("mount_z_deg", station.chain.mount_z_rad);
  angle("mount_x_deg", station.chain.mount_x_rad);
  angle("mount_y_deg", station.chain.mount_y_rad);
  out << "\n[calibration]\nid = " << before.settings.calibration_id + 1 << "\n\n[calibration.sd]\n";
  angle("heading_deg", station.sd.heading_rad);
  angle("tilt_deg", station.sd.tilt_rad);
  angle("mount_deg", station.sd.mount_rad);
  angle("mount_roll_deg", station.sd.mount_roll_rad);
  line("position_m", station.sd.position_m, 3);
}

}  // namespace ols
