#include "tools/doctor/judge_site.h"

#include <algorithm>

#include "conditions/alarms.h"
#include "conditions/printed.h"
#include "tools/doctor/judge_devices.h"

namespace ols::doctor {
namespace {

constexpr std::int64_t kRmemLeast = 8 << 20;
constexpr double kFrameLossWarning = 0.01;
constexpr double kRecent_s = 60.0;
constexpr double kMilli = 1e-3;

double counter(const StationFacts& station, const char* name) {
  const auto found = station.counters.find(name);
  return found == station.counters.end() ? 0.0 : found->second;
}

Finding judge_clock(const StationFacts& station) {
  const std::string error = printed("%.1f ms", station.clock_error_s / kMilli);
  switch (station.clock) {
    case clock::ClockState::kSynchronised:
      return ok("clock: synchronised, error " + error);
    case clock::ClockState::kUnknown:
      return warn("clock: no time service, its error is taken as " + error,
                  "install chrony (examples: chrony-gnss.conf), or compare with other stations");
    case clock::ClockState::kUnsynchronised:
      break;
  }
  return warn("clock: not synchronised, error " + error, advice_on(alarm::clock_lost(0.0, "")));
}

std::optional<Finding> judge_frames(const StationFacts& station) {
  const double captured = counter(station, "frames_captured");
  const double lost = counter(station, "frames_lost") + counter(station, "frames_incomplete");
  if (captured + lost <= 0.0) return std::nullopt;
  const double share = lost / (captured + lost);
  const std::string words =
      "frames: " + printed("%.0f, ", captured) + printed("%.2f %% lost", 100.0 * share);
  if (share <= kFrameLossWarning) return ok(words);
  return warn(words,
              "check the camera's cable; set packet_delay_us; net.core.rmem_max by "
              "60-ols.conf");
}

// No calibration is no fault: the configuration says how little is known. What the checks of a
// calibration found is an alarm of the station.
std::optional<Finding> judge_calibration(const StationFacts::Calibration& calibration) {
  constexpr double kArcsecondsPerRad = 648000.0 / 3.14159265358979323846, kDay_s = 86400.0;
  if (!calibration.in_use) return std::nullopt;
  std::string words =
      "calibration: in use, " + printed("%.0f arc seconds", kArcsecondsPerRad * calibration.sd_rad);
  if (calibration.age_s > 0.0) words += printed(", %.1f days old", calibration.age_s / kDay_s);
  if (!calibration.doubted) return ok(words);
  return warn(words + ", and its reference views have moved",
              "the alarm says what moved; calibrate the setup again");
}

// "3 unsigned, 1 replayed"; empty: none.
std::string distrusted(const std::map<std::string, double>& counters) {
  const std::string prefix = "bus_distrusted_";
  std::string text;
  for (const auto& [name, value] : counters) {
    if (!name.starts_with(prefix) || value <= 0.0) continue;
    text += (text.empty() ? "" : ", ") + printed("%.0f ", value) + name.substr(prefix.size());
  }
  return text;
}

Finding judge_signatures(const BusFacts& bus) {
  if (!bus.trust_trouble.empty()) {
    return fail("signatures: " + bus.trust_trouble.text, advice_on(bus.trust_trouble));
  }
  if (bus.is_verified) {
    const std::string refused = distrusted(bus.distrusted);
    if (refused.empty()) return ok("signatures: all that was heard is signed by the site");
    return warn("signatures: not believed just now: " + refused,
                "docs/troubleshooting.md lists the reasons");
  }
  if (bus.ttl == 0) return ok("signatures: off, on this host only");
  return warn("signatures: off: anybody on this network can command the site",
              "docs/security.md says how to make keys");
}

// Limited: a forged status may have thousands, which would hide the other findings.
Findings judge_alarms(const std::string& whose, const std::vector<Alarm>& alarms) {
  constexpr std::size_t kMost = 16;
  Findings findings;
  for (std::size_t i = 0; i < std::min(alarms.size(), kMost); ++i) {
    findings.push_back(warn(whose + alarms[i].text, std::string(alarms[i].row().action)));
  }
  if (alarms.size() > kMost) {
    const std::string more = std::to_string(alarms.size() - kMost);
    findings.push_back(
        warn(whose + more + " more", "does this message come from a program of this site?"));
  }
  return findings;
}

}  // namespace

Findings judge(const BusFacts& bus) {
  if (!bus.trouble.empty()) {
    return {fail("bus: " + bus.trouble,
                 "name the interface in /etc/ols/bus.env and systemctl restart ols-bus")};
  }
  Findings findings;
  const std::string where = bus.interface.empty() ? "" : " by " + bus.interface;
  if (bus.ttl > 0 && bus.interface == "lo") {
    findings.push_back(warn("bus: " + bus.url + " through lo, which does not reach other hosts",
                            "name the interface in /etc/ols/bus.env and systemctl restart ols-bus "
                            "and the station"));
  } else if (bus.ttl == 0 && !bus.interface.empty() && bus.interface != "lo") {
    findings.push_back(warn("bus: " + bus.url + where + ", but ttl=0 keeps it on this host",
                            "write ttl=1 into lcm_url of every program of the site"));
  } else {
    findings.push_back(ok("bus: " + bus.url + where));
  }
  if (bus.rmem_max > 0 && bus.rmem_max < kRmemLeast) {
    findings.push_back(warn("bus: net.core.rmem_max is " + std::to_string(bus.rmem_max) +
                                ": large messages and frames get lost",
                            "sysctl --system, with 60-ols.conf in place"));
  }
  findings.push_back(judge_signatures(bus));
  return findings;
}

Findings judge_company(const BusFacts& bus, const std::string& own) {
  Findings findings;
  std::string others;
  for (const auto& [id, station] : bus.stations) {
    if (id != own) others += (others.empty() ? "" : ", ") + id + " (" + station.state + ")";
  }
  if (others.empty()) {
    findings.push_back(warn(own.empty() ? "stations: none heard" : "stations: no other heard",
                            "check the network between them, its switch (IGMP snooping without a "
                            "querier drops multicast), and that lcm_url is the same"));
  } else {
    findings.push_back(ok("stations: " + others));
  }
  if (bus.fusions == 0) {
    findings.push_back(warn("fusion: not heard", "systemctl status ols-fusion at the centre"));
  } else if (bus.fusions > 1) {
    findings.push_back(
        fail("fusion: " + std::to_string(bus.fusions) + " of them send slews", "stop all but one"));
  } else {
    findings.push_back(ok("fusion: heard"));
  }
  append(findings, judge_alarms("fusion: alarm: ", bus.fusion_alarms));
  return findings;
}

Findings judge(const StationFacts& station) {
  Findings findings;
  if (station.boots > 1) {
    findings.push_back(
        fail("station: " + std::to_string(station.boots) + " processes use the id " + station.id,
             "give each station its own id"));
  } else {
    findings.push_back(ok("station: " + station.id + " runs, " + station.state));
  }
  for (const device::DeviceReport& device : station.devices) findings.push_back(judge(device));
  findings.push_back(judge_clock(station));
  if (!station.position_known) {
    findings.push_back(
        fail("pose: no position, and so no bearings", advice_on(alarm::no_position())));
  }
  if (const auto calibrated = judge_calibration(station.calibration)) {
    findings.push_back(*calibrated);
  }
  if (const auto frames = judge_frames(station)) findings.push_back(*frames);
  if (const std::string refused = distrusted(station.counters); !refused.empty()) {
    findings.push_back(ok("signatures: not believed since its start: " + refused));
  }
  append(findings, judge_alarms("alarm: ", station.alarms));
  if (!station.last_error.empty() && station.last_error_age_s < kRecent_s) {
    findings.push_back(warn(
        "last error, " + printed("%.0f s ago: ", station.last_error_age_s) + station.last_error,
        "journalctl -u 'ols-station@*' shows more"));
  }
  return findings;
}

}  // namespace ols::doctor
