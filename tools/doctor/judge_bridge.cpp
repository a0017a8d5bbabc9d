#include "tools/doctor/judge_bridge.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "conditions/alarm_json.h"

namespace ols::doctor {
namespace {

using Json = nlohmann::json;

constexpr double kStale_s = 10.0;

Findings judge_status(const Json& status, std::int64_t utime_us) {
  const double written_s = 1e-6 * status.at("utime_us").get<double>();
  if (std::abs(1e-6 * static_cast<double>(utime_us) - written_s) > kStale_s) {
    return {fail("bridge: does not run", "systemctl status ols-bridge.service")};
  }
  Findings findings;
  for (const Alarm& alarm : status.at("alarms").get<std::vector<Alarm>>()) {
    findings.push_back(fail(alarm.text, std::string(alarm.row().action)));
  }
  if (findings.empty()) {
    findings.push_back(
        ok("bridge: connected, " +
           std::to_string(status.at("out").at("passed").get<std::int64_t>()) + " messages out, " +
           std::to_string(status.at("in").at("passed").get<std::int64_t>()) + " in"));
  }
  return findings;
}

}  // namespace

Findings judge_bridge(const std::string& status, std::int64_t utime_us) {
  if (status.empty()) {
    return {warn("bridge: no status",
                 "is status_file set, and does it run? systemctl status ols-bridge.service")};
  }
  try {
    return judge_status(Json::parse(status), utime_us);
  } catch (const Json::exception&) {
    return {fail("bridge: its status cannot be read", "is status_file that of ols-bridge?")};
  }
}

}  // namespace ols::doctor
