#include "tools/calibrate/stationing_files.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "base/config/toml_config.h"
#include "base/files/csv_files.h"
#include "geometry/angles.h"
#include "tools/calibrate/surveyed_place.h"

namespace ols::calibration {
namespace {

const SurveyRow& named(const std::vector<SurveyRow>& survey, const std::string& name) {
  return *std::ranges::find(survey, name, &SurveyRow::landmark);
}

// The result gets the next id.
void check_calibration_id(const std::string& path, std::int64_t id) {
  if (id < std::numeric_limits<std::int64_t>::max()) return;
  throw ConfigFile(path)
      .root()
      .table("calibration")
      .error("id", "is the highest possible: no id is left for the result");
}

// The prior: the station's position and tilt.
StationGeometry rough_station(const StationingOptions& options,
                              const station::StationSettings& settings,
                              const std::vector<SurveyRow>& survey) {
  StationGeometry rough = settings.station.geometry;
  if (!settings.pose.surveyed_tilt_rad) rough.sd.tilt_rad = settings.pose.level_sd_rad;
  if (!options.at.empty()) {
    if (std::ranges::find(survey, options.at, &SurveyRow::landmark) == survey.end()) {
      throw std::invalid_argument("--at: '" + options.at + "' is not in " + options.landmarks);
    }
    const SurveyRow& point = named(survey, options.at);
    rough.position = surveyed_place(point, options.landmarks);
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
  sighting.landmark_ecef = ecef_from_geodetic(surveyed_place(point, options.landmarks));
  sighting.landmark_sd_m = point.sd_m;
  sighting.pixel = {row.x_px.value_or(camera.cx_px), row.y_px.value_or(camera.cy_px)};
  sighting.pixel_sd_px = options.pixel_sd_px;
  sighting.angles = {radians(row.pan_deg), radians(row.tilt_deg)};
  sighting.angles_sd_rad = radians(options.angles_sd_deg);
  return sighting;
}

std::string named(const StationingCase& before, const std::vector<std::size_t>& sightings) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t k = 0; k < std::min(kMost, sightings.size()); ++k) {
    const SightingName& name = before.names[sightings[k]];
    if (!text.empty()) text += ", ";
    text += name.landmark + " (line " + std::to_string(name.line) + ")";
  }
  if (sightings.size() > kMost) {
    text += " and " + std::to_string(sightings.size() - kMost) + " more";
  }
  return text;
}

std::string contradiction(const StationingCase& before, const LandmarksContradict& problem) {
  std::ostringstream text;
  text << before.path << ": " << problem.why() << std::fixed << std::setprecision(3);
  const char* separator = ": ";
  if (!problem.failing().empty()) text << separator << named(before, problem.failing());
  for (const StationingAlternative& one : problem.alternatives()) {
    text << separator << "all others agree without " << named(before, one.rejected)
         << " on a heading of " << degrees(one.heading_rad) << " deg";
    separator = "; or ";
  }
  return text.str();
}

std::string refusal(const StationingCase& before, const LandmarkRefused& problem) {
  const SightingName& name = before.names[problem.sighting()];
  const std::string field = problem.field() == "pixel" ? "x_px" : "landmark";
  return before.path + ":" + std::to_string(name.line) + ": " + field + ": '" + name.landmark +
         "' " + problem.why();
}

}  // namespace

StationingCase read_stationing(const StationingOptions& options) {
  StationingCase result;
  result.settings = station::load_station_settings(options.station);
  check_calibration_id(options.station, result.settings.calibration_id);
  result.path = options.sightings;
  const auto survey = read_survey(options.landmarks);
  result.rough = rough_station(options, result.settings, survey);
  for (const SightedRow& row : read_sighted(options.sightings, survey)) {
    if (row.landmark == options.at) {
      throw CsvError(options.sightings + ":" + std::to_string(row.line) +
                     ": landmark: the station stands at it");
    }
    result.names.push_back({row.landmark, row.line});
    result.sightings.push_back(
        sighting_of(row, named(survey, row.landmark), result.rough.camera, options));
  }
  return result;
}

Stationing find_station(const StationingCase& before, double highest_rad) {
  try {
    return station_by_landmarks(before.rough, before.sightings, highest_rad);
  } catch (const LandmarksContradict& problem) {
    throw CsvError(contradiction(before, problem));
  } catch (const LandmarkRefused& problem) {
    throw CsvError(refusal(before, problem));
  } catch (const std::invalid_argument& problem) {
    throw CsvError(before.path + ": " + problem.what());
  }
}

}  // namespace ols::calibration
