#include "tools/exporter/site_metrics.h"

#include <algorithm>
#include <utility>

#include "ols_msg/bearing_t.hpp"
#include "tools/exporter/alarm_metrics.h"
#include "tools/exporter/metric_collection.h"
#include "wire/station_status.h"

namespace ols::exporter {
namespace {

using ols_msg::fusion_status_t;
using ols_msg::station_status_t;
using prometheus::MetricFamily;

// As doubles: a member may state any two times, whose difference no integer holds.
double seconds_since(std::int64_t utime_us, std::int64_t now_us) {
  return 1e-6 * (static_cast<double>(now_us) - static_cast<double>(utime_us));
}

void add_state(MetricCollection& all, const std::string& id, const station_status_t& s,
               double age_s) {
  all.gauge("ols_station_status_age_seconds", "Since its last status was heard.", {{"station", id}},
            age_s);
  all.gauge("ols_station_state", "1 for what the station does now.",
            {{"station", id}, {"state", wire::state_name(s.state)}}, 1.0);
  add_alarms(all, "station", id, alarms_of(s, SiteMetrics::kMostNames));
  all.gauge("ols_station_frame_latency_seconds", "Mid-exposure to bearing, smoothed.",
            {{"station", id}}, s.frame_latency_s);
  const bool synchronised = s.clock_state == ols_msg::bearing_t::CLOCK_SYNCHRONISED;
  all.gauge("ols_station_clock_synchronised", "1 while its UTC is synchronised.", {{"station", id}},
            synchronised ? 1.0 : 0.0);
  all.gauge("ols_station_clock_error_seconds", "1-sigma of its UTC.", {{"station", id}},
            s.clock_error_s);
}

// One version for each station: after an update the previous one is gone.
void add_version(MetricCollection& all, const std::string& id, const station_status_t& s) {
  all.gauge("ols_station_build_info", "1; the version of the station's program.",
            {{"station", id}, {"version", wire::software(s)}}, 1.0);
  if (s.last_error.empty()) return;
  all.gauge("ols_station_last_error_age_seconds", "Since the newest error in its status.",
            {{"station", id}}, seconds_since(s.last_error_utime, s.utime));
}

void add_calibration(MetricCollection& all, const std::string& id, const station_status_t& s) {
  const bool doubted = s.calibration_state == station_status_t::CALIBRATION_DOUBTED;
  const bool used = doubted || s.calibration_state == station_status_t::CALIBRATION_IN_USE;
  all.gauge("ols_station_calibration_in_use", "1 while an adjusted calibration is in use.",
            {{"station", id}}, used ? 1.0 : 0.0);
  all.gauge("ols_station_calibration_doubted", "1 while the stored views contradict it.",
            {{"station", id}}, doubted ? 1.0 : 0.0);
  if (s.calibration_utime <= 0) return;
  all.gauge("ols_station_calibration_age_seconds", "Since its last observation.", {{"station", id}},
            seconds_since(s.calibration_utime, s.utime));
}

template <class Use>
void first_names(const std::vector<std::string>& names, const Use& use) {
  for (std::size_t i = 0; i < std::min(names.size(), SiteMetrics::kMostNames); ++i) use(i);
}

void add_named(MetricCollection& all, const std::string& id, const station_status_t& s) {
  first_names(s.device_name, [&](std::size_t i) {
    if (s.device_name[i] == "software") return;  // no device
    const bool works = s.device_state[i] == station_status_t::DEVICE_OK;
    all.gauge("ols_station_device_up", "1 while the device works.",
              {{"station", id}, {"device", s.device_name[i]}}, works ? 1.0 : 0.0);
  });
  first_names(s.reading_name, [&](std::size_t i) {
    all.gauge("ols_station_reading", "A reading, in the unit that ends its name.",
              {{"station", id}, {"reading", s.reading_name[i]}}, s.reading_value[i]);
  });
  first_names(s.counter_name, [&](std::size_t i) {
    all.counter("ols_station_events_total", "A counter of the station, since its start.",
                {{"station", id}, {"event", s.counter_name[i]}}, s.counter_value[i]);
  });
}

void add_fusion(MetricCollection& all, const fusion_status_t& s, double age_s) {
  all.gauge("ols_fusion_status_age_seconds", "Since its last status was heard.", {}, age_s);
  add_alarms(all, "fusion", "", alarms_of(s, SiteMetrics::kMostNames));
  all.gauge("ols_fusion_latency_seconds", "Mid-exposure to published target, median.", {},
            s.latency_s);
  all.gauge("ols_fusion_stations", "Stations that it has heard.", {},
            static_cast<double>(s.stations_known));
  for (std::size_t i = 0; i < s.station.size(); ++i) {
    const Labels of{{"station", s.station[i]}};
    all.counter("ols_bearings_total", "Bearings that the fusion has accepted.", of,
                static_cast<double>(s.bearings[i]));
    all.gauge("ols_bearing_rate_hertz", "Recent bearings of a station.", of, s.rate_hz[i]);
    all.gauge("ols_bearing_residual", "Recent RMS of its normalised residuals.", of, s.residual[i]);
    all.gauge("ols_station_quarantined", "1 while its bearings are not used.", of,
              s.quarantine[i].empty() ? 0.0 : 1.0);
  }
  first_names(s.counter_name, [&](std::size_t i) {
    all.counter("ols_fusion_events_total", "A counter of the fusion, since its start.",
                {{"event", s.counter_name[i]}}, s.counter_value[i]);
  });
}

}  // namespace

void SiteMetrics::receive(const station_status_t& status, double now_s) {
  std::erase_if(stations_, [&](const auto& one) { return now_s - one.second.at_s > kForget_s; });
  const bool known = stations_.contains(status.station);
  if (known || stations_.size() < kMostStations) stations_[status.station] = {status, now_s};
}

void SiteMetrics::receive(const fusion_status_t& status, double now_s) {
  fusion_ = {status, now_s};
}

void SiteMetrics::know(std::vector<std::string> enrolled) {
  for (const std::string& id : enrolled_) {
    if (std::ranges::find(enrolled, id) == enrolled.end()) stations_.erase(id);
  }
  enrolled_ = std::move(enrolled);
}

void SiteMetrics::hear_distrusted(std::map<std::string, double> by_reason) {
  distrusted_ = std::move(by_reason);
}

std::vector<MetricFamily> SiteMetrics::families(double now_s) const {
  MetricCollection all;
  all.gauge("ols_build_info", "1; the version of the exporter.", {{"version", version_}}, 1.0);
  for (const auto& [reason, count] : distrusted_) {
    all.counter("ols_bus_distrusted_total", "Messages that the exporter did not believe.",
                {{"reason", reason}}, count);
  }
  for (const std::string& id : enrolled_) {
    all.gauge("ols_station_enrolled", "1 for each station of the trust list, heard or not.",
              {{"station", id}}, 1.0);
  }
  for (const auto& [id, heard] : stations_) {
    add_state(all, id, heard.status, now_s - heard.at_s);
    add_version(all, id, heard.status);
    add_calibration(all, id, heard.status);
    add_named(all, id, heard.status);
  }
  if (fusion_) add_fusion(all, fusion_->status, now_s - fusion_->at_s);
  return all.take();
}

}  // namespace ols::exporter
