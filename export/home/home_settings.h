// How targets and stations appear on an MQTT broker.
#pragma once

#include <string>

namespace ols::exports {

struct HomeSettings {
  std::string prefix = "ols";
  std::string discovery_prefix = "homeassistant";
  int slots = 8;  // targets with entities of their own at the same time
};

}  // namespace ols::exports
