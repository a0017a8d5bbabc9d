#include "tools/exporter/bridge_metrics.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "conditions/alarm_json.h"
#include "tools/exporter/alarm_metrics.h"
#include "tools/exporter/metric_collection.h"

namespace ols::exporter {
namespace {

using Json = nlohmann::json;

// Not all are their senders' faults: some are of another site, or of another owner.
void add_direction(MetricCollection& all, const std::string& direction, const Json& counts) {
  all.counter("ols_bridge_messages_total", "Messages that passed.", {{"direction", direction}},
              counts.at("passed").get<double>());
  for (const auto& [reason, count] : counts.at("refused").items()) {
    all.counter("ols_bridge_refused_total", "Messages that did not pass.",
                {{"direction", direction}, {"reason", reason}}, count.get<double>());
  }
}

void add_link(MetricCollection& all, const Json& link) {
  all.gauge("ols_bridge_link_up", "1 while a server of NATS is connected.", {},
            link.at("open").get<bool>() ? 1.0 : 0.0);
  all.counter("ols_bridge_link_losses_total", "Connections that ended.", {},
              link.at("losses").get<double>());
  all.counter("ols_bridge_unsent_total", "Messages that had no connection.", {{"to", "network"}},
              link.at("unsent").get<double>());
}

void add_ownership(MetricCollection& all, const Json& ownership) {
  all.gauge("ols_bridge_owners_confirmed", "1 while the store of owners answers.", {},
            ownership.at("confirmed").get<bool>() ? 1.0 : 0.0);
  all.gauge("ols_bridge_targets", "Targets that this fusion owns, and those of others.",
            {{"owner", "own"}}, ownership.at("owned").get<double>());
  all.gauge("ols_bridge_targets", "", {{"owner", "other"}}, ownership.at("others").get<double>());
  all.gauge("ols_bridge_owner_epoch",
            "The greatest epoch with which it owns a target, and that it obeyed; 0: none.",
            {{"of", "own"}}, ownership.at("epoch").get<double>());
  all.gauge("ols_bridge_owner_epoch", "", {{"of", "obeyed"}},
            ownership.at("obeyed_epoch").get<double>());
}

double age_s(const Json& status, std::int64_t utime_us) {
  return 1e-6 * (static_cast<double>(utime_us) - status.at("utime_us").get<double>());
}

// Throws Json::exception where something is missing or of another type.
std::vector<prometheus::MetricFamily> told(const std::string& text, std::int64_t utime_us) {
  const Json status = Json::parse(text);
  MetricCollection all;
  const bool runs = std::abs(age_s(status, utime_us)) <= kStaleBridge_s;
  all.gauge("ols_bridge_up", "1 while the bridge writes its status.", {}, runs ? 1.0 : 0.0);
  if (!runs) return all.take();
  add_alarms(all, "bridge", "", status.at("alarms").get<std::vector<Alarm>>());
  all.gauge("ols_bridge_stations", "Stations whose messages pass.", {},
            status.at("stations").get<double>());
  add_direction(all, "out", status.at("out"));
  add_direction(all, "in", status.at("in"));
  all.counter("ols_bridge_missing_total", "Messages that never came, by their senders' sequences.",
              {}, status.at("missing").get<double>());
  add_link(all, status.at("link"));
  all.counter("ols_bridge_unsent_total", "", {{"to", "bus"}},
              status.at("unsent_to_bus").get<double>());
  add_ownership(all, status.at("ownership"));
  return all.take();
}

}  // namespace

std::vector<prometheus::MetricFamily> bridge_metrics(const std::string& status,
                                                     std::int64_t utime_us) {
  try {
    return told(status, utime_us);
  } catch (const Json::exception&) {
    MetricCollection all;
    all.gauge("ols_bridge_up", "1 while the bridge writes its status.", {}, 0.0);
    return all.take();
  }
}

}  // namespace ols::exporter
