#include "export/mqtt/discovery.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "export/mqtt/mqtt_encoder.h"
#include "export/text.h"

namespace ols::exports {
namespace {

using Json = nlohmann::ordered_json;

// What the entities of one device have in common.
struct Device {
  const MqttSettings& settings;
  const std::string& site;
  std::string id, name, topic;
};

Packet entity(const Device& device, const std::string& component, const std::string& what,
              const std::string& name, Json more) {
  const std::string id = device.id + (what.empty() ? "" : "_" + what);
  Json config{
      {"name", name.empty() ? Json(nullptr) : Json(name)},
      {"unique_id", id},
      {"default_entity_id", component + "." + id},
      {"availability_topic", status_topic(device.settings, device.site)},
      {"device", {{"identifiers", {device.id}}, {"name", device.name}, {"manufacturer", "OLS"}}}};
  config.update(more);
  // Home Assistant does not let places on the map expire.
  if (device.settings.stale_s > 0.0 && component != "device_tracker") {
    config["expire_after"] = std::llround(device.settings.stale_s);
  }
  const std::string topic =
      device.settings.discovery_prefix + "/" + component + "/" + id + "/config";
  return {topic, config.dump(-1, ' ', false, Json::error_handler_t::replace), topic, true};
}

Json reading(const Device& device, const std::string& field) {
  return {{"state_topic", device.topic},
          {"value_template", "{{ value_json." + field + " | default(none) }}"}};
}

// `device_class`: of Home Assistant, which has none for angles: empty.
Packet sensor(const Device& device, const std::string& field, const std::string& name,
              const std::string& unit, const std::string& device_class) {
  Json config = reading(device, field);
  config["unit_of_measurement"] = unit;
  config["state_class"] = "measurement";
  if (!device_class.empty()) config["device_class"] = device_class;
  return entity(device, "sensor", field, name, std::move(config));
}

Packet one_of(const Device& device, const std::string& field, const std::string& name,
              const std::vector<std::string>& options) {
  Json config = reading(device, field);
  config["device_class"] = "enum";
  config["options"] = options;
  return entity(device, "sensor", field, name, std::move(config));
}

// The states of a slot; "none" while it is free.
std::vector<std::string> states_of_targets() {
  return {"none", to_string(TrackState::kTentative), to_string(TrackState::kConfirmed),
          to_string(TrackState::kCoasted)};
}

std::vector<std::string> classes_of_targets() {
  std::vector<std::string> classes;
  for (const auto& one : wire::kObjectClasses) classes.emplace_back(one.name);
  return classes;
}

}  // namespace

std::string slot_topic(const std::string& prefix, std::size_t slot) {
  return prefix + "/target/" + std::to_string(slot + 1);
}

Packets discover_slot(const MqttSettings& settings, const std::string& site, std::size_t slot) {
  const std::string number = std::to_string(slot + 1);
  const Device device{settings, site, topic_word(site) + "_target_" + number,
                      site + " target " + number, slot_topic(site_prefix(settings, site), slot)};
  return {
      entity(device, "device_tracker", "", "",
             {{"json_attributes_topic", device.topic},
              {"state_topic", device.topic},
              {"value_template", "{{ 'not_home' if value_json.latitude is defined else 'None' }}"},
              {"source_type", "gps"}}),
      one_of(device, "state", "State", states_of_targets()),
      one_of(device, "class", "Class", classes_of_targets()),
      sensor(device, "height_above_sea_m", "Height above the sea", "m", "distance"),
      sensor(device, "height_above_ground_m", "Height above the ground", "m", "distance"),
      sensor(device, "height_ellipsoid_m", "Height above the ellipsoid", "m", "distance"),
      sensor(device, "speed_m_s", "Speed", "m/s", "speed"),
      sensor(device, "gps_accuracy", "Accuracy", "m", "distance")};
}

Packets discover_station(const MqttSettings& settings, const std::string& site,
                         const std::string& word, const std::string& name) {
  const Device device{settings, site, topic_word(site) + "_station_" + word, site + " " + name,
                      site_prefix(settings, site) + "/station/" + word};
  return {one_of(device, "state", "State", {kStationStates.begin(), kStationStates.end()}),
          sensor(device, "azimuth_deg", "Azimuth", "°", ""),
          sensor(device, "elevation_deg", "Elevation", "°", ""),
          entity(device, "binary_sensor", "problem", "Alarm",
                 {{"state_topic", device.topic},
                  {"value_template", "{{ value_json.problem }}"},
                  {"device_class", "problem"}})};
}

}  // namespace ols::exports
