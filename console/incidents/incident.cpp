#include "console/incidents/incident.h"

#include <algorithm>
#include <stdexcept>

namespace ols::console {
namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 3> kVerdicts{"open", "confirmed", "dismissed"};

Json json_of(const TrackPoint& p) {
  return {p.utime_us, p.longitude_deg, p.latitude_deg, p.height_m};
}

TrackPoint point_from(const Json& json) { return {json.at(0), json.at(1), json.at(2), json.at(3)}; }

Json track_json(const std::vector<TrackPoint>& track) {
  Json points = Json::array();
  for (const TrackPoint& point : track) points.push_back(json_of(point));
  return points;
}

// Throws the parser's own exceptions.
Incident read(const Json& json) {
  Incident incident;
  json.at("number").get_to(incident.number);
  json.at("area").get_to(incident.area);
  json.at("target").get_to(incident.target);
  json.at("class").get_to(incident.object_class);
  json.at("class_probability").get_to(incident.class_probability);
  json.at("begun_us").get_to(incident.begun_us);
  json.at("ended_us").get_to(incident.ended_us);
  json.at("entries").get_to(incident.entries);
  json.at("stations").get_to(incident.stations);
  json.at("judged_by").get_to(incident.judged_by);
  json.at("judged_us").get_to(incident.judged_us);
  incident.picture = json.at("picture");
  const auto verdict = judgement_named(json.at("verdict").get<std::string>());
  if (!verdict) throw std::invalid_argument("unknown verdict");
  incident.verdict = *verdict;
  incident.last = point_from(json.at("last"));
  for (const Json& point : json.at("track")) incident.track.push_back(point_from(point));
  json.at("track_period_us").get_to(incident.track_period_us);
  return incident;
}

}  // namespace

std::string_view name(Judgement verdict) { return kVerdicts[static_cast<std::size_t>(verdict)]; }

std::optional<Judgement> judgement_named(std::string_view name) {
  const auto found = std::ranges::find(kVerdicts, name);
  if (found == kVerdicts.end()) return std::nullopt;
  return static_cast<Judgement>(found - kVerdicts.begin());
}

void add_to_track(const TrackPoint& point, Incident& incident) {
  std::vector<TrackPoint>& track = incident.track;
  if (!track.empty() && point.utime_us < track.back().utime_us + incident.track_period_us) return;
  track.push_back(point);
  if (track.size() <= kMostTrackPoints) return;
  incident.track_period_us *= 2;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < track.size(); i += 2) track[kept++] = track[i];
  track.resize(kept);
}

Json json_of(const Incident& incident) {
  return {{"number", incident.number},
          {"area", incident.area},
          {"target", incident.target},
          {"class", incident.object_class},
          {"class_probability", incident.class_probability},
          {"begun_us", incident.begun_us},
          {"ended_us", incident.ended_us},
          {"entries", incident.entries},
          {"stations", incident.stations},
          {"last", json_of(incident.last)},
          {"track", track_json(incident.track)},
          {"track_period_us", incident.track_period_us},
          {"verdict", name(incident.verdict)},
          {"judged_by", incident.judged_by},
          {"judged_us", incident.judged_us},
          {"picture", incident.picture}};
}

Incident incident_from(const Json& json) {
  try {
    return read(json);
  } catch (const Json::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace ols::console
