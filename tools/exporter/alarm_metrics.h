// Adds alarms to the metrics. Pure.
#pragma once

#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "tools/exporter/metric_collection.h"

namespace ols::exporter {

// `program`: "station", "fusion" or "bridge". `station`: empty for the last two.
void add_alarms(MetricCollection& all, const std::string& program, const std::string& station,
                const std::vector<Alarm>& alarms);

}  // namespace ols::exporter
