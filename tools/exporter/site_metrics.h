// The site's statuses as Prometheus metrics, with base units and names by Prometheus' conventions.
// Target ids are not used as labels, because Prometheus stores every value of a label for ever.
// Pure.
#pragma once

#include <prometheus/metric_family.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ols_msg/fusion_status_t.hpp"
#include "ols_msg/station_status_t.hpp"

namespace ols::exporter {

class SiteMetrics {
 public:
  // Max number of stations. A station that is silent for kForget_s is forgotten. It is still
  // reported as enrolled, so that alerts about it do not end.
  static constexpr std::size_t kMostStations = 1000;
  static constexpr double kForget_s = 86400.0;
  // Max number of names (readings, counters, devices) per message.
  static constexpr std::size_t kMostNames = 200;

  explicit SiteMetrics(std::string version) : version_(std::move(version)) {}

  // Takes a status. Pass only verified statuses. Times are monotonic.
  void receive(const ols_msg::station_status_t& status, double now_s);
  void receive(const ols_msg::fusion_status_t& status, double now_s);
  // Takes the stations of the trust list. Stations that are no longer on it are no longer reported.
  void know(std::vector<std::string> enrolled);
  // Takes the number of messages since the start that failed verification, by reason.
  void hear_distrusted(std::map<std::string, double> by_reason);

  std::vector<prometheus::MetricFamily> families(double now_s) const;

 private:
  struct HeardStation {
    ols_msg::station_status_t status;
    double at_s = 0.0;
  };
  struct HeardFusion {
    ols_msg::fusion_status_t status;
    double at_s = 0.0;
  };

  std::string version_;
  std::vector<std::string> enrolled_;
  std::map<std::string, HeardStation> stations_;
  std::optional<HeardFusion> fusion_;
  std::map<std::string, double> distrusted_;
};

}  // namespace ols::exporter
