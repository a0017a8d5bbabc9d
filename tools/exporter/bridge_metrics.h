// ols-bridge's status as Prometheus metrics. It has no key for the bus, so nothing that it said
// there would be believed: the metrics come from its status file on this host. Pure.
#pragma once

#include <prometheus/metric_family.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ols::exporter {

// status: the file's text; empty: none. An older status, or none, gives only the metric that the
// bridge does not run.
inline constexpr double kStaleBridge_s = 10.0;
std::vector<prometheus::MetricFamily> bridge_metrics(const std::string& status,
                                                     std::int64_t utime_us);

}  // namespace ols::exporter
