#include "export/files/courageous.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/files/fnv1a.h"
#include "export/text.h"

namespace ols::exports {
namespace {

using Json = nlohmann::ordered_json;

Json position(double latitude_deg, double longitude_deg, double above_sea_m) {
  return {{"lat", latitude_deg},
          {"lon", longitude_deg},
          {"height_amsl", std::round(100.0 * above_sea_m) / 100.0}};
}

Json position(const Place& place) {
  return position(place.latitude_deg, place.longitude_deg, place.above_sea_m());
}

Json location(const Place& place) {
  Json result = position(place);
  result["$type"] = "Position3d";
  return result;
}

std::uint64_t milliseconds(std::int64_t utime_us) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(utime_us, 0) / 1000);
}

// The format asks for a certainty, which the fusion does not have: confirmed targets count as
// certain.
Json alarm(TrackState state) {
  const bool is_confirmed = state == TrackState::kConfirmed || state == TrackState::kEnded;
  return {{"active", state != TrackState::kTentative}, {"certainty", is_confirmed ? 1.0 : 0.5}};
}

// The format has no birds and no aircraft: they become others.
const char* classification(ObjectClass object_class) {
  const bool is_named =
      object_class == ObjectClass::kUnknown || object_class == ObjectClass::kDrone;
  return standard_class(is_named ? object_class : ObjectClass::kOther);
}

Json track_record(const Target& target, std::uint64_t number) {
  Json record{{"alarm", alarm(target.state)},
              {"classification", classification(target.object_class)},
              {"location", location(target.place)},
              {"record_number", number},
              {"time", milliseconds(target.utime_us)}};
  const auto& [east, north, up] = target.velocity_enu_m_s;
  if (std::isfinite(east + north + up)) {
    record["velocity"] = {{"east", east}, {"north", north}, {"up", up}};
  }
  return record;
}

Json detection_record(const Line& line, std::uint64_t number) {
  return {{"alarm", {{"active", true}, {"certainty", std::clamp(line.belief, 0.0, 1.0)}}},
          {"classification", "Unknown"},
          {"cuas_location", position(line.camera)},
          {"location",
           {{"$type", "BearingElevation"},
            {"bearing", line.azimuth_deg},
            {"elevation", line.elevation_deg}}},
          {"record_number", number},
          {"time", milliseconds(line.utime_us)}};
}

// Null: not known.
Json place_of_system(const Picture& picture, const CourageousSettings& settings) {
  if (settings.has_place()) {
    return position(settings.latitude_deg, settings.longitude_deg, settings.height_above_sea_m);
  }
  if (!picture.stations().empty()) return position(picture.stations().begin()->second.place);
  if (picture.lines().empty()) return nullptr;
  return position(picture.lines().begin()->second.points.front().camera);
}

// A number that no other target has, not even of another run of the fusion, and that is the same in
// each file. Short enough for readers with floating-point numbers to tell them apart.
std::uint64_t uas_id(const std::string& uid) {
  constexpr std::uint64_t kMost = (std::uint64_t{1} << 53U) - 1U;
  return fnv1a(uid) & kMost;
}

}  // namespace

std::string courageous(const Picture& picture, const std::string& site,
                       const CourageousSettings& settings) {
  const Json here = place_of_system(picture, settings);
  if (here.is_null() || picture.is_empty()) return {};
  std::uint64_t number = 0;
  Json tracks = Json::array(), detections = Json::array();
  for (const auto& [uid, track] : picture.tracks()) {
    Json records = Json::array();
    for (const Target& point : track.points) records.push_back(track_record(point, number++));
    tracks.push_back({{"uas_id", uas_id(uid)}, {"name", uid}, {"records", std::move(records)}});
  }
  for (const auto& [uid, seen] : picture.lines()) {
    Json records = Json::array();
    for (const Line& line : seen.points) records.push_back(detection_record(line, number++));
    detections.push_back({{"name", seen.points.front().station}, {"records", std::move(records)}});
  }
  const Json document{{"version", "0.4.1"},      {"vendor_name", "OLS"},
                      {"system_name", site},     {"static_cuas_location", here},
                      {"detection", detections}, {"tracks", tracks}};
  return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ols::exports
