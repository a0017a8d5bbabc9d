#include "export/files/geojson.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "export/text.h"
#include "export/uncertainty.h"

namespace ols::exports {
namespace {

using Json = nlohmann::ordered_json;

// Null for what is unknown. Rounded: a file needs no 17 digits.
Json number(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

Json position(const Place& place) {
  return {number(place.longitude_deg, 8), number(place.latitude_deg, 8), number(place.height_m, 2)};
}

Json feature(const std::string& id, const char* type, Json coordinates, Json properties) {
  return {{"type", "Feature"},
          {"id", id},
          {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}},
          {"properties", std::move(properties)}};
}

Json covariance(const Covariance& values) {
  Json numbers = Json::array();
  for (const double value : values) numbers.push_back(number(value, 6));
  return numbers;
}

Json target_properties(const Target& target) {
  const Motion motion = motion_of(target);
  return {{"kind", "target"},
          {"name", callsign(target)},
          {"time", iso_time(target.utime_us)},
          {"state", to_string(target.state)},
          {"height_ellipsoid_m", number(target.place.height_m, 2)},
          {"height_above_sea_m", number(target.place.above_sea_m(), 2)},
          {"height_above_ground_m", number(target.above_ground_m, 1)},
          {"height_above_ground_sd_m", number(rounded_up(target.above_ground_sd_m, 1), 1)},
          {"speed_m_s", number(motion.speed_m_s, 2)},
          {"course_deg", number(motion.course_deg, 1)},
          {"climb_m_s", number(motion.climb_m_s, 2)},
          {"covariance_enu_m2", covariance(target.covariance_m2)},
          {"class", to_string(target.object_class)},
          {"class_probability", number(target.class_probability, 2)},
          {"size_m", number(target.size_m, 2)},
          {"size_sd_m", number(rounded_up(target.size_sd_m, 2), 2)},
          {"stations", target.stations}};
}

Json station_properties(const Station& station) {
  return {{"kind", "station"},
          {"name", station.name},
          {"time", iso_time(station.utime_us)},
          {"state", station.state},
          {"alarms", station.alarms},
          {"azimuth_deg", number(station.azimuth_deg, 3)},
          {"elevation_deg", number(station.elevation_deg, 3)},
          {"sd_enu_m",
           {number(station.position_sd_m[0], 3), number(station.position_sd_m[1], 3),
            number(station.position_sd_m[2], 3)}}};
}

Json line_properties(const Line& line) {
  return {{"kind", "line"},
          {"name", line.station},
          {"time", iso_time(line.utime_us)},
          {"azimuth_deg", number(line.azimuth_deg, 5)},
          {"elevation_deg", number(line.elevation_deg, 5)},
          {"cross_sd_deg", number(line.cross_sd_deg, 6)},
          {"elevation_sd_deg", number(line.elevation_sd_deg, 6)},
          {"belief", number(line.belief, 2)}};
}

}  // namespace

std::string geojson(const Picture& picture, double line_m) {
  Json features = Json::array();
  for (const auto& [uid, track] : picture.tracks()) {
    features.push_back(
        feature(uid, "Point", position(track.last.place), target_properties(track.last)));
    if (track.points.size() < 2) continue;
    Json path = Json::array(), times = Json::array();
    for (const Target& point : track.points) {
      path.push_back(position(point.place));
      times.push_back(iso_time(point.utime_us));
    }
    // The name by which converters of GPX and players of tracks know the points' times.
    features.push_back(feature(
        uid + ".track", "LineString", std::move(path),
        {{"kind", "track"}, {"name", callsign(track.last)}, {"coordTimes", std::move(times)}}));
  }
  for (const auto& [uid, station] : picture.stations()) {
    features.push_back(feature(uid, "Point", position(station.place), station_properties(station)));
  }
  for (const auto& [uid, seen] : picture.lines()) {
    const Line& line = seen.points.back();
    features.push_back(feature(uid, "LineString",
                               {position(line.camera), position(end_of(line, line_m))},
                               line_properties(line)));
  }
  const Json document{{"type", "FeatureCollection"}, {"features", std::move(features)}};
  return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ols::exports
