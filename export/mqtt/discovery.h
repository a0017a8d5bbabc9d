// Home Assistant's MQTT discovery: the messages that it needs once to show an entity. Pure.
#pragma once

#include <cstddef>
#include <string>

#include "export/encoder.h"
#include "export/mqtt/mqtt_settings.h"

namespace ols::exports {

// `prefix`: site_prefix().
std::string slot_topic(const std::string& prefix, std::size_t slot);

// A place on the map, with height, speed and state as sensors.
Packets discover_slot(const MqttSettings& settings, const std::string& site, std::size_t slot);
// State and direction as sensors, and whether the station has an alarm. `word`: the station's name
// in topics.
Packets discover_station(const MqttSettings& settings, const std::string& site,
                         const std::string& word, const std::string& name);

}  // namespace ols::exports
