// The site's statuses as metrics for Prometheus. Base units; names as its conventions have them; no
// target's id anywhere, because labels live for ever. Pure.
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
  // Of more stations nothing is kept, nor of a silent one after a day; that it is enrolled is told
  // on, so that alerts last.
  static constexpr std::size_t kMostStations = 1000;
  static constexpr double kForget_s = 86400.0;
  // Of what one message names: readings, counters, devices.
  static constexpr std::size_t kMostNames = 200;

  explicit SiteMetrics(std::string version) : version_(std::move(version)) {}

  // Statuses as verified. Times: monotonic.
  void hear(const ols_msg::station_status_t& status, double now_s);
  void hear(const ols_msg::fusion_status_t& status, double now_s);
  // The stations of the trust list; of one that is in it no more nothing is told.
  void know(std::vector<std::string> enrolled);
  // Messages that were not believed, by reason, since the start.
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
