// Settings for targets and stations at an MQTT broker.
#pragma once

#include <string>

namespace ols::exports {

struct MqttSettings {
  std::string prefix = "ols";
  std::string discovery_prefix = "homeassistant";
  double stale_s = 30.0;  // an entity without news for this long is unavailable; 0: never
  int slots = 8;          // number of targets that can have an entity of their own at the same time
};

}  // namespace ols::exports
