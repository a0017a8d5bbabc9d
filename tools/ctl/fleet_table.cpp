#include "tools/ctl/fleet_table.h"

#include <cmath>

#include "conditions/printed.h"
#include "ols_msg/bearing_t.hpp"
#include "wire/station_status.h"

namespace ols::ctl {
namespace {

using ols_msg::station_status_t;

// "3 d", "5 h", "12 min".
std::string age(double seconds) {
  constexpr double kMinute_s = 60.0, kHour_s = 3600.0, kDay_s = 86400.0;
  if (seconds >= 2.0 * kDay_s) return printed("%.0f d", seconds / kDay_s);
  if (seconds >= 2.0 * kHour_s) return printed("%.0f h", seconds / kHour_s);
  return printed("%.0f min", seconds / kMinute_s);
}

std::string age_at(const station_status_t& s, std::int64_t utime_us) {
  return age(1e-6 * (static_cast<double>(s.utime) - static_cast<double>(utime_us)));
}

std::string calibration(const station_status_t& s) {
  if (s.calibration_state == station_status_t::CALIBRATION_NONE) return "-";
  const std::string words = wire::calibration_name(s.calibration_state);
  const bool is_used = s.calibration_state != station_status_t::CALIBRATION_REFUSED;
  return is_used && s.calibration_utime > 0 ? words + ", " + age_at(s, s.calibration_utime) : words;
}

std::string clock(const station_status_t& s) {
  if (s.clock_state != ols_msg::bearing_t::CLOCK_SYNCHRONISED) return "not synchronised";
  return std::isfinite(s.clock_error_s) ? printed("%.2f ms", 1e3 * s.clock_error_s) : "-";
}

double reading(const station_status_t& s, const std::string& name) {
  for (std::size_t i = 0; i < s.reading_name.size(); ++i) {
    if (s.reading_name[i] == name) return s.reading_value[i];
  }
  return std::nan("");
}

std::string disk(const station_status_t& s) {
  const double bytes = reading(s, "disk_free_bytes");
  return std::isfinite(bytes) ? printed("%.1f GB", 1e-9 * bytes) : "-";
}

std::string warmth(const station_status_t& s) {
  const double degC = reading(s, "cpu_degC");
  return std::isfinite(degC) ? printed("%.0f degC", degC) : "-";
}

std::string alarm(const station_status_t& s) {
  if (s.alarm.empty()) {
    if (s.last_error.empty()) return "-";
    return s.last_error + " (" + age_at(s, s.last_error_utime) + " ago, over)";
  }
  const std::string more =
      s.alarm.size() > 1 ? " (and " + std::to_string(s.alarm.size() - 1) + " more)" : "";
  return s.alarm.back() + more;
}

constexpr const char* kLine = "%-12s %-10s %-10s %-16s %-17s %-9s %-8s ";

}  // namespace

std::string fleet_table(const std::map<std::string, station_status_t>& statuses,
                        const std::vector<std::string>& enrolled) {
  std::string table =
      printed(kLine, "station", "state", "version", "calibration", "clock", "disk", "cpu") +
      "alarm\n";
  for (const auto& [id, s] : statuses) {
    table += printed(kLine, id.c_str(), wire::state_name(s.state), wire::software(s).c_str(),
                     calibration(s).c_str(), clock(s).c_str(), disk(s).c_str(), warmth(s).c_str()) +
             alarm(s) + "\n";
  }
  for (const std::string& id : enrolled) {
    if (statuses.contains(id)) continue;
    table += printed(kLine, id.c_str(), "not heard", "-", "-", "-", "-", "-") + "-\n";
  }
  return table;
}

}  // namespace ols::ctl
