#include "tools/doctor/judge_host.h"

#include <cstdlib>
#include <cstring>
#include <sstream>

#include "conditions/printed.h"

namespace ols::doctor {
namespace {

constexpr double kGiga = 1e9;

}  // namespace

Finding judge(const clock::ClockQuality& clock) {
  const std::string words =
      "clock: " + clock.text + (clock.alarm.empty() ? "" : " (" + clock.alarm.text + ")");
  if (clock.state == clock::ClockState::kSynchronised && clock.alarm.empty()) return ok(words);
  if (clock.state == clock::ClockState::kUnknown) {
    return warn(words, "install chrony; examples: chrony-gnss.conf");
  }
  return warn(words, "chronyc sources and chronyc tracking show why");
}

Finding judge(const FolderFacts& folder) {
  const std::string words = "disk: " + folder.name + " " + folder.folder;
  if (folder.error != 0) {
    return fail(words + ": " + std::strerror(folder.error),
                "make it (systemd-tmpfiles --create), give it to user ols, check that the disk is "
                "mounted writable");
  }
  const std::string free = ", " + printed("%.1f GB free", folder.free_bytes / kGiga);
  if (folder.free_bytes < folder.reserve_bytes) {
    return warn(words + free, "free disk space: recording pauses below" +
                                  printed(" %.1f GB", folder.reserve_bytes / kGiga));
  }
  return ok(words + free);
}

Findings judge(const station::HostReport& host) {
  Findings findings;
  for (const Alarm& alarm : host.alarms) {
    findings.push_back(warn("host: " + alarm.text, std::string(alarm.row().action)));
  }
  const auto cpu = host.readings.find("cpu_degC");
  if (host.alarms.empty() && cpu != host.readings.end()) {
    findings.push_back(ok("host: processor" + printed(" %.0f degC", cpu->second)));
  }
  return findings;
}

std::optional<Finding> judge(const UnitFacts& unit) {
  if (unit.load != "loaded") return std::nullopt;
  const std::string words =
      "service: " + unit.id + " " + unit.active + (unit.status.empty() ? "" : ", " + unit.status);
  const std::string journal = "journalctl -u " + unit.id + " -n 20";
  if (unit.active == "failed") {
    return fail(words + " (" + unit.result + ")",
                journal + " shows why; it is restarted every minute");
  }
  if (unit.active == "activating") return warn(words + " (" + unit.sub + ")", journal);
  if (unit.active != "active") return warn(words, "systemctl enable --now " + unit.id);
  if (unit.restarts > 0) {
    return warn(words + ", started again " + std::to_string(unit.restarts) + " times", journal);
  }
  return ok(words);
}

std::vector<UnitFacts> parse_units(const std::string& text) {
  std::vector<UnitFacts> units;
  std::istringstream lines(text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find('=');
    if (equals == std::string::npos) {
      inside = false;  // an empty line ends a block
      continue;
    }
    if (!inside) units.emplace_back();
    inside = true;
    UnitFacts& unit = units.back();
    const std::string key = line.substr(0, equals), value = line.substr(equals + 1);
    if (key == "Id") unit.id = value;
    if (key == "LoadState") unit.load = value;
    if (key == "ActiveState") unit.active = value;
    if (key == "SubState") unit.sub = value;
    if (key == "Result") unit.result = value;
    if (key == "StatusText") unit.status = value;
    if (key == "NRestarts") unit.restarts = std::atoi(value.c_str());
  }
  return units;
}

std::string parse_route(const std::string& text) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word == "dev" && words >> word) return word;
  }
  return {};
}

}  // namespace ols::doctor
