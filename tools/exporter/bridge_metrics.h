// What ols-bridge says of itself, as metrics for Prometheus. It has no key of the bus, so nothing
// that it said there would be believed: it is known by its status file on this host. Pure.
#pragma once

#include <prometheus/metric_family.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ols::exporter {

// status: the file's text; empty: there is none. A status that is older, or no status at all, says
// only that the bridge does not run.
inline constexpr double kStaleBridge_s = 10.0;
std::vector<prometheus::MetricFamily> bridge_metrics(const std::string& status,
                                                     std::int64_t utime_us);

}  // namespace ols::exporter
