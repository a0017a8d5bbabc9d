#include "export/home/discovery.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "export/home/home_encoder.h"

namespace ols::exports {
namespace {

using Json = nlohmann::ordered_json;

// What the entities of one device have in common.
struct Device {
  const HomeSettings& settings;
  std::string id, name, topic;
};

Packet entity(const Device& device, const std::string& component, const std::string& what,
              const std::string& name, Json more) {
  const std::string id = device.id + (what.empty() ? "" : "_" + what);
  Json config{
      {"name", name.empty() ? Json(nullptr) : Json(name)},
      {"unique_id", id},
      {"object_id", id},
      {"availability_topic", status_topic(device.settings)},
      {"device", {{"identifiers", {device.id}}, {"name", device.name}, {"manufacturer", "OLS"}}}};
  config.update(more);
  // Home Assistant knows no such thing of places on the map.
  if (device.settings.stale_s > 0.0 && component != "device_tracker") {
    config["expire_after"] = std::llround(device.settings.stale_s);
  }
  const std::string topic =
      device.settings.discovery_prefix + "/" + component + "/" + id + "/config";
  return {topic, config.dump(-1, ' ', false, Json::error_handler_t::replace), topic, true};
}

Packet sensor(const Device& device, const std::string& field, const std::string& name,
              const std::string& unit) {
  Json config{{"state_topic", device.topic},
              {"value_template", "{{ value_json." + field + " | default(none) }}"}};
  if (!unit.empty()) {
    config["unit_of_measurement"] = unit;
    config["state_class"] = "measurement";
  }
  return entity(device, "sensor", field, name, std::move(config));
}

}  // namespace

std::string slot_topic(const HomeSettings& settings, std::size_t slot) {
  return settings.prefix + "/target/" + std::to_string(slot + 1);
}

Packets discover_slot(const HomeSettings& settings, const std::string& site, std::size_t slot) {
  const std::string number = std::to_string(slot + 1);
  const Device device{settings, site + "_target_" + number, site + " target " + number,
                      slot_topic(settings, slot)};
  return {
      entity(device, "device_tracker", "", "",
             {{"json_attributes_topic", device.topic},
              {"state_topic", device.topic},
              {"value_template", "{{ 'not_home' if value_json.latitude is defined else 'None' }}"},
              {"source_type", "gps"}}),
      sensor(device, "state", "State", ""),
      sensor(device, "height_above_sea_m", "Height above the sea", "m"),
      sensor(device, "height_ellipsoid_m", "Height above the ellipsoid", "m"),
      sensor(device, "speed_m_s", "Speed", "m/s"),
      sensor(device, "gps_accuracy", "Accuracy", "m")};
}

Packets discover_station(const HomeSettings& settings, const std::string& site,
                         const std::string& word, const std::string& name) {
  const Device device{settings, site + "_station_" + word, site + " " + name,
                      settings.prefix + "/station/" + word};
  return {sensor(device, "state", "State", ""), sensor(device, "azimuth_deg", "Azimuth", "°"),
          sensor(device, "elevation_deg", "Elevation", "°"),
          entity(device, "binary_sensor", "problem", "Alarm",
                 {{"state_topic", device.topic},
                  {"value_template", "{{ value_json.problem }}"},
                  {"device_class", "problem"}})};
}

}  // namespace ols::exports
