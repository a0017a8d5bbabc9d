#include "bridge/status.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "conditions/alarm_json.h"
#include "conditions/alarms.h"

namespace ols::bridge {
namespace {

using Json = nlohmann::ordered_json;

// With more between two renewals, leases run out: docs/bridge.md.
constexpr double kLongestDelay_s = 0.9;

std::uint64_t refused(const Counts& counts) {
  const auto none = static_cast<std::size_t>(Refusal::kOwn);
  const auto others = static_cast<std::size_t>(Refusal::kNotOwned);
  const std::uint64_t all =
      std::accumulate(counts.refused.begin(), counts.refused.end(), std::uint64_t{0});
  return all - counts.refused[none] - counts.refused[others];
}

Json json_of(const Counts& counts) {
  Json reasons = Json::object();
  for (std::size_t i = 0; i < counts.refused.size(); ++i) {
    reasons[to_string(static_cast<Refusal>(i))] = counts.refused[i];
  }
  return {{"passed", counts.passed}, {"refused", reasons}, {"last_refusal", counts.last_refusal}};
}

std::string direction(const char* name, const Counts& counts) {
  std::string line = std::string(name) + " " + std::to_string(counts.passed);
  if (refused(counts) == 0) return line;
  return line + ", " + std::to_string(refused(counts)) + " refused (last " + counts.last_refusal +
         ")";
}

}  // namespace

std::vector<Alarm> alarms(const BridgeStatus& status) {
  std::vector<Alarm> all = status.bus_alarms;
  if (!status.link.is_open) all.push_back(alarm::bridge_no_server(status.link.trouble));
  if (!status.link.refusal.empty()) {
    all.push_back(alarm::bridge_refused(status.link.refusal));
  }
  if (!status.gap.empty()) all.push_back(alarm::bridge_messages_missing(status.gap));
  if (!status.late.empty()) all.push_back(alarm::bridge_late(status.late));
  if (status.archive.is_wanted && !status.archive.is_kept) {
    all.push_back(alarm::bridge_archive_fails(status.archive.trouble));
  }
  for (const std::string& site : status.archive.standing) {
    all.push_back(alarm::bridge_archive_stands(site));
  }
  if (status.ownership.is_wanted && !status.ownership.is_confirmed) {
    all.push_back(alarm::bridge_owners_silent());
  }
  if (status.ownership.is_wanted && status.ownership.delay_s > kLongestDelay_s) {
    all.push_back(alarm::bridge_owners_slow());
  }
  return all;
}

std::string in_one_line(const BridgeStatus& status) {
  std::string line = status.link.is_open ? "connected" : "not connected";
  line.append("; ").append(direction("out", status.out));
  line.append("; ").append(direction("in", status.in));
  for (const Alarm& alarm : alarms(status)) line.append("; ").append(alarm.text);
  return line;
}

std::string to_json(const BridgeStatus& status) {
  const LinkStatus& link = status.link;
  const OwnershipStatus& own = status.ownership;
  const Json json{{"utime_us", status.utime_us},
                  {"alarms", alarms(status)},
                  {"counters", status.bus_counters},
                  {"stations", status.stations},
                  {"out", json_of(status.out)},
                  {"in", json_of(status.in)},
                  {"missing", status.missing},
                  {"repeated", status.repeated},
                  {"unsent_to_bus", status.unsent_to_bus},
                  {"link",
                   {{"open", link.is_open},
                    {"trouble", link.trouble},
                    {"openings", link.openings},
                    {"losses", link.losses},
                    {"sent", link.sent},
                    {"unsent", link.unsent},
                    {"displaced", link.displaced},
                    {"refusals", link.refusals}}},
                  {"archive",
                   {{"kept", status.archive.is_kept},
                    {"trouble", status.archive.trouble},
                    {"messages", status.archive.messages},
                    {"bytes", status.archive.bytes},
                    {"standing_still", status.archive.standing}}},
                  {"ownership",
                   {{"confirmed", own.is_confirmed},
                    {"owned", own.owned},
                    {"others", own.others},
                    {"taken", own.taken},
                    {"handed_over", own.handed_over},
                    {"lost", own.lost},
                    {"epoch", own.epoch},
                    {"delay_s", own.delay_s},
                    {"obeyed_epoch", status.obeyed_epoch}}}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::string> standing_still(const std::map<std::string, double>& heard_ago_s,
                                        const std::map<std::string, double>& archived_ago_s,
                                        double patience_s) {
  std::vector<std::string> sites;
  for (const auto& [site, ago_s] : heard_ago_s) {
    const auto archived = archived_ago_s.find(site);
    if (archived == archived_ago_s.end() || ago_s > patience_s / 2.0) continue;
    if (archived->second > patience_s) sites.push_back(site);
  }
  return sites;
}

}  // namespace ols::bridge
