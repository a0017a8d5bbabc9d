#include "bridge/stream_plan.h"

#include <algorithm>

namespace ols::bridge {
namespace {

constexpr double kNanosecondsPerHour = 3.6e12;

std::string stream_of(const std::string& region, const std::string& site) {
  return "OLS_" + region + (site.empty() ? "" : "_" + site);
}

void add(std::vector<std::string>& subjects, const std::string& stations) {
  subjects.push_back(stations + ".bearing");
  subjects.push_back(stations + ".status");
}

// The first part; what follows it stays in `text`.
std::string cut_part(std::string& text) {
  const std::size_t dot = text.find('.');
  std::string part = text.substr(0, dot);
  text = dot == std::string::npos ? "" : text.substr(dot + 1);
  return part;
}

}  // namespace

std::optional<StreamPlan> plan_stream(const BridgeConfig& config) {
  if (!config.archive.is_on) return std::nullopt;
  const bool is_site = config.role == Role::kSite;
  const std::string region = "ols.v1." + config.region;
  StreamPlan plan;
  plan.name = stream_of(config.region, is_site ? config.site : "");
  plan.keep_ns = static_cast<std::int64_t>(config.archive.keep_h * kNanosecondsPerHour);
  plan.most_bytes = static_cast<std::int64_t>(config.archive.most_bytes);
  for (const std::string& site : config.archive.sources) {
    plan.sources.push_back({stream_of(config.region, site), site});
  }
  // What is copied from the sites must not be heard here a second time.
  if (is_site) {
    add(plan.subjects, region + "." + config.site + ".*");
  } else if (plan.sources.empty()) {
    add(plan.subjects, region + ".*.*");
  }
  if (config.targets) plan.subjects.push_back(region + ".target");
  return plan;
}

bool is_same_stream(const BridgeConfig& config, const std::vector<std::string>& subjects,
                    const std::vector<std::string>& sources) {
  const bool is_site = config.role == Role::kSite;
  const std::string region = "ols.v1." + config.region + ".";
  const std::string here = is_site ? region + config.site + "." : region;
  const std::string streams = stream_of(config.region, "") + "_";
  return std::ranges::all_of(subjects,
                             [&](const std::string& one) {
                               return one.starts_with(here) || one == region + "target";
                             }) &&
         std::ranges::all_of(
             sources, [&](const std::string& one) { return !is_site && one.starts_with(streams); });
}

bool covers(const std::string& pattern, const std::string& subject) {
  std::string wanted = pattern, given = subject;
  while (!wanted.empty() && !given.empty()) {
    const std::string part = cut_part(wanted);
    if (part == ">") return true;
    if (const std::string is = cut_part(given); part != "*" && part != is) return false;
  }
  return wanted.empty() && given.empty();
}

}  // namespace ols::bridge
