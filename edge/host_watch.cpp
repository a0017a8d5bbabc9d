#include "edge/host_watch.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

namespace ols {
namespace {

// The hottest zone, whatever it is called: kernels name them as they like.
std::optional<double> hottest_degC(const std::string& folder) {
  std::optional<double> hottest;
  std::error_code none;
  for (const auto& zone : std::filesystem::directory_iterator(folder, none)) {
    if (!zone.path().filename().string().starts_with("thermal_zone")) continue;
    double millidegrees = 0.0;
    if (std::ifstream(zone.path() / "temp") >> millidegrees) {
      hottest = std::max(hottest.value_or(-273.0), millidegrees * 1e-3);
    }
  }
  return hottest;
}

std::optional<double> free_bytes(const std::string& folder) {
  struct statvfs disk {};
  if (statvfs(folder.c_str(), &disk) != 0) return std::nullopt;
  return static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
}

std::string in_words(const char* format, double value) {
  char text[96];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

void HostWatch::note_turn(double seconds) {
  slowest_s_ = std::max(slowest_s_, seconds);
  if (seconds > config_.slow_turn_s) ++slow_turns_;
}

HostReport HostWatch::look() {
  HostReport report;
  if (const auto cpu_degC = hottest_degC(config_.thermal_folder)) {
    report.readings["cpu_degC"] = *cpu_degC;
    if (*cpu_degC > config_.cpu_alarm_degC) {
      report.alarms.push_back(in_words("computer: processor at %.0f C", *cpu_degC));
    }
  }
  if (const auto bytes = free_bytes(config_.disk_folder)) {
    report.readings["disk_free_bytes"] = *bytes;
    if (*bytes < config_.disk_alarm_bytes) {
      report.alarms.push_back(in_words("computer: %.0f MB left on the disk", *bytes * 1e-6));
    }
  }
  report.readings["slowest_turn_s"] = slowest_s_;
  slowest_s_ = 0.0;
  return report;
}

}  // namespace ols
