// How targets and stations appear on an MQTT broker.
#pragma once

#include <string>

namespace ols::exports {

struct MqttSettings {
  std::string prefix = "ols";
  std::string discovery_prefix = "homeassistant";
  double stale_s = 30.0;  // without news for this time, an entity is unavailable; 0: never
  int slots = 8;          // number of targets with their own entities at the same time
};

}  // namespace ols::exports
