// ols-bridge's status as Prometheus metrics. The bridge has no key for the bus, so a status
// on the bus could not be verified. The metrics therefore come from the bridge's status file on
// this host. Pure.
#pragma once

#include <prometheus/metric_family.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ols::exporter {

// `status`: the file's text; empty: there is no file. If the status is missing or older than
// kStaleBridge_s, the only metric says that the bridge does not run.
inline constexpr double kStaleBridge_s = 10.0;
std::vector<prometheus::MetricFamily> bridge_metrics(const std::string& status,
                                                     std::int64_t utime_us);

}  // namespace ols::exporter
