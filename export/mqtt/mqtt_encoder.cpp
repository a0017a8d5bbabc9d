#include "export/mqtt/mqtt_encoder.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "export/mqtt/discovery.h"
#include "export/text.h"
#include "export/uncertainty.h"

namespace ols::exports {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostStations = 500;
constexpr double kSaidInTime = 3.0;  // times before it is stale, because one may be lost

Json number(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

Json deviation(double value, int decimals) { return number(rounded_up(value, decimals), decimals); }

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void add_place(const Place& place, Json& fields) {
  fields["latitude"] = number(place.latitude_deg, 8);
  fields["longitude"] = number(place.longitude_deg, 8);
  fields["height_ellipsoid_m"] = number(place.height_m, 2);
  fields["height_above_sea_m"] = number(place.above_sea_m(), 2);
}

void add_uncertainty(const Target& target, Json& fields) {
  const Ellipse ellipse = ellipse_of(target.covariance_m2);
  // Home Assistant's own name of the radius within which a thing is.
  fields["gps_accuracy"] = deviation(ellipse.semi_major_m, 2);
  fields["ellipse_semi_major_m"] = deviation(ellipse.semi_major_m, 3);
  fields["ellipse_semi_minor_m"] = deviation(ellipse.semi_minor_m, 3);
  fields["ellipse_azimuth_deg"] = number(ellipse.azimuth_deg, 1);
  fields["height_sd_m"] = deviation(sd(target.covariance_m2[5]), 3);
}

Json json_of(const Target& target) {
  Json fields{{"id", target.uid},
              {"number", target.id},
              {"time", iso_time(target.utime_us)},
              {"state", to_string(target.state)}};
  add_place(target.place, fields);
  fields["height_above_ground_m"] = number(target.above_ground_m, 1);
  fields["height_above_ground_sd_m"] = deviation(target.above_ground_sd_m, 1);
  add_uncertainty(target, fields);
  const Motion motion = motion_of(target);
  fields["speed_m_s"] = number(motion.speed_m_s, 2);
  fields["course_deg"] = number(motion.course_deg, 1);
  fields["climb_m_s"] = number(motion.climb_m_s, 2);
  fields["class"] = to_string(target.object_class);
  fields["class_probability"] = number(target.class_probability, 2);
  fields["size_m"] = number(target.size_m, 2);
  fields["stations"] = target.stations.size();
  return fields;
}

Json json_of(const Station& station) {
  Json fields{{"id", station.uid},
              {"name", station.name},
              {"time", iso_time(station.utime_us)},
              {"state", station.state}};
  add_place(station.place, fields);
  fields["azimuth_deg"] = number(station.azimuth_deg, 2);
  fields["elevation_deg"] = number(station.elevation_deg, 2);
  fields["field_of_view_deg"] = number(station.field_of_view_deg[0], 2);
  fields["alarms"] = station.alarms;
  fields["problem"] = station.is_well ? "OFF" : "ON";
  fields["clock"] = station.clock_is_good ? "synchronised" : "doubtful";
  return fields;
}

Json json_of(const Line& line) {
  Json fields{{"id", line.uid}, {"station", line.station}, {"time", iso_time(line.utime_us)}};
  add_place(line.camera, fields);
  fields["azimuth_deg"] = number(line.azimuth_deg, 5);
  fields["elevation_deg"] = number(line.elevation_deg, 5);
  fields["cross_sd_deg"] = deviation(line.cross_sd_deg, 6);
  fields["elevation_sd_deg"] = deviation(line.elevation_sd_deg, 6);
  fields["belief"] = number(line.belief, 2);
  return fields;
}

Json json_of(const Incident& incident) {
  Json fields{{"id", incident.uid},
              {"number", incident.number},
              {"time", iso_time(incident.utime_us)},
              {"area", incident.area},
              {"alarm", incident.is_alarm() ? "ON" : "OFF"},
              {"state", incident.is_inside() ? "inside" : "left"},
              {"begun", iso_time(incident.begun_us)},
              {"ended", incident.is_inside() ? Json(nullptr) : Json(iso_time(incident.ended_us))},
              {"verdict", incident.verdict},
              {"judged_by", incident.judged_by},
              {"target", incident.target_uid},
              {"class", incident.object_class},
              {"class_probability", number(incident.class_probability, 2)}};
  add_place(incident.place, fields);
  fields["stations"] = incident.stations;
  return fields;
}

Packet retained(const std::string& topic, const Json& json) {
  return {topic, text_of(json), topic, true};
}

Packet free_slot(const std::string& topic) { return retained(topic, {{"state", "none"}}); }

}  // namespace

std::string site_prefix(const MqttSettings& settings, const std::string& site) {
  return settings.prefix + "/" + topic_word(site);
}

std::string status_topic(const MqttSettings& settings, const std::string& site) {
  return site_prefix(settings, site) + "/status";
}

std::string topic_word(const std::string& name) {
  std::string word = name;
  std::ranges::replace_if(
      word,
      [](unsigned char c) { return c >= 0x80 || (std::isalnum(c) == 0 && c != '-' && c != '_'); },
      '_');
  return word;
}

MqttEncoder::MqttEncoder(MqttSettings settings, std::string site)
    : settings_(std::move(settings)),
      site_(std::move(site)),
      prefix_(site_prefix(settings_, site_)),
      slots_(static_cast<std::size_t>(settings_.slots)) {}

Packets MqttEncoder::encode(const Target& target) {
  const bool has_ended = target.state == TrackState::kEnded;
  const Json fields = json_of(target);
  const std::string all = prefix_ + "/targets";
  Packets packets{{all + "/" + target.uid, text_of(fields), all}};
  const auto slot = has_ended ? slots_.release(target.uid) : slots_.take(target.uid);
  if (!slot) return packets;
  const std::string topic = slot_topic(prefix_, *slot);
  packets.push_back(has_ended ? free_slot(topic) : retained(topic, fields));
  return packets;
}

Packets MqttEncoder::encode(const Station& station) {
  Packets packets;
  const std::string word = topic_word(station.name);
  if (announced_stations_.size() < kMostStations && announced_stations_.insert(word).second) {
    packets = discover_station(settings_, site_, word, station.name);
  }
  packets.push_back(retained(prefix_ + "/station/" + word, json_of(station)));
  return packets;
}

Packets MqttEncoder::encode(const Line& line) {
  const std::string topic = prefix_ + "/line/" + topic_word(line.station);
  return {{topic, text_of(json_of(line)), topic}};
}

Packets MqttEncoder::encode_incident(const Incident& incident) {
  return {{incident.uid, text_of(json_of(incident)), prefix_ + "/incidents"}};
}

bool MqttEncoder::is_free_slot_due(std::int64_t utime_us) const {
  if (!slots_are_announced_) return true;
  if (settings_.stale_s <= 0.0) return false;
  // A clock that was set back must not stop the repetition.
  const double early_s = 1e-6 * static_cast<double>(free_due_us_ - utime_us);
  return early_s <= 0.0 || early_s > settings_.stale_s / kSaidInTime;
}

Packets MqttEncoder::due(std::int64_t utime_us) {
  Packets packets;
  if (!is_free_slot_due(utime_us)) return packets;
  free_due_us_ = utime_us + std::llround(1e6 * settings_.stale_s / kSaidInTime);
  const bool is_new = !std::exchange(slots_are_announced_, true);
  for (std::size_t slot = 0; slot < slots_.count(); ++slot) {
    if (is_new) {
      for (Packet& packet : discover_slot(settings_, site_, slot)) {
        packets.push_back(std::move(packet));
      }
    }
    if (slots_.is_free(slot)) packets.push_back(free_slot(slot_topic(prefix_, slot)));
  }
  return packets;
}

void MqttEncoder::begin_again() {
  slots_are_announced_ = false;
  announced_stations_.clear();
}

}  // namespace ols::exports
