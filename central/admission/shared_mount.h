// Finds stations that steer the same mount: two stations on one camera contradict each other's
// orders. Pure.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "central/admission/station_registry.h"
#include "conditions/alarm.h"

namespace ols::fusion {

// An alarm for each two stations whose mounts have the same maker, model and serial number.
std::vector<Alarm> shared_mount_alarms(const std::map<std::string, KnownStation>& stations);

}  // namespace ols::fusion
