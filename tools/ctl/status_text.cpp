#include "tools/ctl/status_text.h"

#include <algorithm>
#include <cmath>

#include "conditions/alarm.h"
#include "conditions/printed.h"
#include "geometry/angles.h"
#include "ols_msg/bearing_t.hpp"
#include "wire/station_status.h"

namespace ols::ctl {
namespace {

using wire::clock_name;
using wire::counter;
using wire::device_name;
using wire::device_state;
using wire::source_name;
using wire::state_name;

template <class... Values>
std::string line(const char* format, Values... values) {
  return printed(format, values...) + "\n";
}

// "-" for an unknown value.
std::string shown(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  return printed("%.*f", decimals, value);
}

std::string shown_deg(double rad, int decimals) { return shown(degrees(rad), decimals); }

std::string pose_text(const ols_msg::station_status_t& s) {
  std::string text;
  text += line("position   %s %s deg, %s m, +- %s %s %s m east north up (%s)",
               shown(s.latitude_deg, 7).c_str(), shown(s.longitude_deg, 7).c_str(),
               shown(s.height_m, 2).c_str(), shown(s.position_sd_m[0], 3).c_str(),
               shown(s.position_sd_m[1], 3).c_str(), shown(s.position_sd_m[2], 3).c_str(),
               source_name(s.position_source));
  text += line("heading    %s +- %s deg", shown_deg(s.heading_rad, 3).c_str(),
               shown_deg(s.heading_sd_rad, 4).c_str());
  text += line("tilt       %s %s +- %s deg (%s)", shown_deg(s.tilt_x_rad, 4).c_str(),
               shown_deg(s.tilt_y_rad, 4).c_str(), shown_deg(s.tilt_sd_rad, 4).c_str(),
               source_name(s.tilt_source));
  text += line("points to  azimuth %s, elevation %s deg; pan %s, tilt %s deg",
               shown_deg(s.azimuth_rad, 3).c_str(), shown_deg(s.elevation_rad, 3).c_str(),
               shown_deg(s.pan_rad, 2).c_str(), shown_deg(s.tilt_rad, 2).c_str());
  return text;
}

std::string lens_text(const ols_msg::station_status_t& s) {
  if (s.kind != ols_msg::station_status_t::KIND_OVERVIEW) return "";
  return line("lens       zoom %s, focus %s, iris %s; focal length %s +- %s px",
              shown(s.lens_position[0], 3).c_str(), shown(s.lens_position[1], 3).c_str(),
              shown(s.lens_position[2], 3).c_str(), shown(s.focal_length_px, 1).c_str(),
              shown(s.focal_length_sd_px, 1).c_str());
}

std::string device_text(const ols_msg::station_status_t& s) {
  std::string text = "devices\n";
  for (std::size_t i = 0; i < s.device_name.size(); ++i) {
    const std::string age =
        std::isfinite(s.device_age_s[i]) ? shown(s.device_age_s[i], 1) + " s ago" : "never";
    text += line("  %-12s %-9s %-12s %s", s.device_name[i].c_str(), device_name(s.device_state[i]),
                 age.c_str(), s.device_text[i].c_str());
  }
  return text;
}

std::string named_numbers(const char* heading, const std::vector<std::string>& names,
                          const std::vector<double>& values) {
  std::string text = std::string(heading) + "\n";
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += line("  %-36s %.10g", names[i].c_str(), values[i]);
  }
  return text;
}

}  // namespace

std::string status_table(const Operator::Statuses& statuses) {
  const char* format = "%-12s %-9s %6s %9s %9s %8s %8s  %-8s %-8s %8s %6s %6s  %s";
  std::string text = line(format, "station", "state", "belief", "azim deg", "elev deg", "pan deg",
                          "tilt deg", "camera", "ptu", "frames", "lost", "alarms", "last error");
  for (const auto& [id, s] : statuses) {
    const double lost = counter(s, "frames_lost") + counter(s, "frames_incomplete");
    text += line(format, id.c_str(), state_name(s.state), shown(s.belief, 2).c_str(),
                 shown_deg(s.azimuth_rad, 3).c_str(), shown_deg(s.elevation_rad, 3).c_str(),
                 shown_deg(s.pan_rad, 2).c_str(), shown_deg(s.tilt_rad, 2).c_str(),
                 device_state(s, "camera"), device_state(s, "ptu"),
                 shown(counter(s, "frames_captured"), 0).c_str(), shown(lost, 0).c_str(),
                 std::to_string(s.alarm.size()).c_str(), s.last_error.c_str());
  }
  return text;
}

std::string full_status(const ols_msg::station_status_t& s, std::int64_t now_utime_us) {
  const auto ago_s = [now_utime_us](std::int64_t utime_us) {
    return shown(1e-6 * static_cast<double>(now_utime_us - utime_us), 0);
  };
  std::string text =
      line("station    %s, boot %lld", s.station.c_str(), static_cast<long long>(s.boot_id));
  text += line("state      %s, track %lld, belief %s", state_name(s.state),
               static_cast<long long>(s.track_id), shown(s.belief, 2).c_str());
  if (s.hidden_since_utime != 0) {
    text += "hidden     for " + ago_s(s.hidden_since_utime) + " s";
    if (s.hidden_until_utime != 0) {
      const double in_s = 1e-6 * static_cast<double>(s.hidden_until_utime - now_utime_us);
      text += ", expected back in " + shown(std::max(0.0, in_s), 0) + " s";
    }
    text += "\n";
  }
  text += pose_text(s);
  text += lens_text(s);
  text += line("clock      %s, +- %.3g s; frame to bearing %s s", clock_name(s.clock_state),
               s.clock_error_s, shown(s.frame_latency_s, 3).c_str());
  text += device_text(s);
  text += s.alarm.empty() ? "no alarm\n" : "alarms\n";
  constexpr std::size_t kMost = 16;  // a forged status may have thousands
  for (const Alarm& alarm : alarms_of(s, kMost)) {
    text += "  " + alarm.text + "\n";
    text.append("    ").append(alarm.row().action).append("\n");
  }
  if (s.alarm.size() > kMost) text += "  and " + std::to_string(s.alarm.size() - kMost) + " more\n";
  if (!s.last_error.empty()) {
    text += "last error, " + ago_s(s.last_error_utime) + " s ago: " + s.last_error + "\n";
  }
  text += named_numbers("readings", s.reading_name, s.reading_value);
  text += named_numbers("counters", s.counter_name, s.counter_value);
  return text;
}

}  // namespace ols::ctl
