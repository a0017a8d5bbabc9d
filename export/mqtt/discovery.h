// Home Assistant's MQTT discovery: the messages by which Home Assistant learns of an entity. Each
// is sent once per connection. Pure.
#pragma once

#include <cstddef>
#include <string>

#include "export/encoder.h"
#include "export/mqtt/mqtt_settings.h"

namespace ols::exports {

// `prefix`: site_prefix().
std::string slot_topic(const std::string& prefix, std::size_t slot);

// Announces a slot: a place on the map, with height, speed and state as sensors.
Packets discover_slot(const MqttSettings& settings, const std::string& site, std::size_t slot);
// Announces a station: state and direction as sensors, and whether the station has an alarm.
// `word`: the station's name as it appears in topics.
Packets discover_station(const MqttSettings& settings, const std::string& site,
                         const std::string& word, const std::string& name);

}  // namespace ols::exports
