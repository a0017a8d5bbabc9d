#include "export/tak/cot_event.h"

#include <algorithm>
#include <cmath>

#include "export/text.h"
#include "export/uncertainty.h"

namespace ols::exports {
namespace {

std::int64_t stale_us(std::int64_t utime_us, double seconds) {
  return utime_us + static_cast<std::int64_t>(seconds * 1e6);
}

std::string attribute(const char* name, double value, int decimals) {
  const std::string text = fixed(value, decimals);
  if (text.empty()) return {};
  std::string result(" ");
  return result.append(name).append("=\"").append(text).append("\"");
}

std::string covariance_attribute(const char* name, const Covariance& covariance) {
  if (!std::ranges::all_of(covariance, [](double v) { return std::isfinite(v); })) return {};
  std::string text(" ");
  text.append(name).append("=\"");
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    text.append(i > 0 ? " " : "").append(fixed(covariance[i], 4));
  }
  return text.append("\"");
}

std::string stations_of(const Target& target) {
  std::string names;
  for (const std::string& station : target.stations) {
    names.append(names.empty() ? "" : " ").append(xml(station));
  }
  return names;
}

// A drone in the air has a type of its own. Birds have none, and the types of aircraft distinguish
// civil from military ones, which no station can.
std::string target_type(const CotSettings& settings, bool is_drone) {
  const bool is_air = settings.target_type.size() == 5 && settings.target_type.ends_with("-A");
  return settings.target_type + (is_drone && is_air ? "-M-F-Q" : "");
}

std::string target_detail(const Target& target) {
  std::string text("<_ols_ state=\"");
  text.append(to_string(target.state)).append("\" stations=\"").append(stations_of(target));
  text.append("\"")
      .append(covariance_attribute("covariance_enu_m2", target.covariance_m2))
      .append(
          covariance_attribute("velocity_covariance_enu_m2_s2", target.velocity_covariance_m2_s2))
      .append(attribute("climb_m_s", target.velocity_enu_m_s[2], 2))
      .append(attribute("height_above_ground_m", target.above_ground_m, 1))
      .append(attribute("height_above_ground_sd_m", target.above_ground_sd_m, 1))
      .append(" class=\"")
      .append(to_string(target.object_class))
      .append("\"")
      .append(attribute("class_probability", target.class_probability, 2))
      .append("/>");
  return text;
}

// From <sensor> clients draw the cone in which a camera looks.
std::string station_detail(const Station& station, double line_m) {
  std::string text;
  if (std::isfinite(station.azimuth_deg)) {
    text.append("<sensor")
        .append(attribute("azimuth", station.azimuth_deg, 2))
        .append(attribute("elevation", station.elevation_deg, 2))
        .append(attribute("fov", station.field_of_view_deg[0], 2))
        .append(attribute("vfov", station.field_of_view_deg[1], 2))
        .append(attribute("range", line_m, 0))
        .append(" type=\"r-e\" model=\"OLS\" north=\"0\" roll=\"0\"/>");
  }
  text.append("<_ols_ state=\"").append(xml(station.state)).append("\" alarms=\"");
  text.append(std::to_string(station.alarms)).append("\" clock=\"");
  return text.append(station.clock_is_good ? "synchronised" : "doubtful").append("\"/>");
}

std::string line_detail(const Line& line, double line_m) {
  std::string text("<range value=\"");
  text.append(fixed(line_m, 0)).append("\"/><bearing value=\"").append(fixed(line.azimuth_deg, 4));
  text.append("\"/><inclination value=\"").append(fixed(line.elevation_deg, 4));
  text.append("\"/><rangeUnits value=\"1\"/><bearingUnits value=\"0\"/><northRef value=\"0\"/>");
  text.append("<_ols_ station=\"").append(xml(line.station)).append("\"");
  return text.append(attribute("cross_sd_deg", rounded_up(line.cross_sd_deg, 5), 5))
      .append(attribute("elevation_sd_deg", rounded_up(line.elevation_sd_deg, 5), 5))
      .append(attribute("belief", line.belief, 2))
      .append("/>");
}

std::string incident_detail(const Incident& incident, const std::string& callsign,
                            const CotSettings& settings) {
  const bool is_alarm = incident.is_alarm();
  std::string text(is_alarm ? "<emergency type=\"Geo-fence Breached\">"
                            : "<emergency cancel=\"true\">");
  text.append(xml(callsign)).append("</emergency><link relation=\"p-p\" type=\"");
  text.append(xml(target_type(settings, incident.object_class == "drone")))
      .append("\" uid=\"")
      .append(xml(incident.target_uid));
  text.append("\"/><_ols_ area=\"").append(xml(incident.area)).append("\" class=\"");
  text.append(xml(incident.object_class)).append("\" verdict=\"").append(incident.verdict);
  text.append("\" judged_by=\"").append(xml(incident.judged_by)).append("\"");
  return text.append(attribute("class_probability", incident.class_probability, 2)).append("/>");
}

}  // namespace

CotEvent cot_event(const Target& target, const CotSettings& settings) {
  CotEvent event;
  const bool has_ended = target.state == TrackState::kEnded;
  event.type = target_type(settings, target.object_class == ObjectClass::kDrone);
  event.uid = target.uid;
  event.how = "m-f";  // by a machine, fused
  event.callsign = callsign(target);
  event.utime_us = target.utime_us;
  event.stale_us = stale_us(target.utime_us, has_ended ? 0.0 : settings.stale_s);
  event.point = target.place;
  event.ce_m = ellipse_of(target.covariance_m2).semi_major_m;
  event.le_m = sd(target.covariance_m2[5]);
  const Motion motion = motion_of(target);
  event.speed_m_s = motion.speed_m_s;
  event.course_deg = motion.course_deg;
  event.geopoint_source = "CALC";
  event.detail = target_detail(target);
  return event;
}

CotEvent cot_event(const Station& station, const CotSettings& settings) {
  CotEvent event;
  event.type = settings.station_type;
  event.uid = station.uid;
  event.how = "m-g";
  event.callsign = station.name;
  event.utime_us = station.utime_us;
  event.stale_us = stale_us(station.utime_us, settings.stale_s);
  event.point = station.place;
  event.ce_m = std::max(station.position_sd_m[0], station.position_sd_m[1]);
  event.le_m = station.position_sd_m[2];
  event.geopoint_source = "GPS";
  event.detail = station_detail(station, settings.line_m);
  return event;
}

CotEvent cot_event(const Incident& incident, const CotSettings& settings) {
  CotEvent event;
  event.type = incident.is_alarm() ? "b-a-g" : "b-a-o-can";
  event.uid = incident.uid;
  event.how = "m-f";
  event.callsign =
      incident.area + ": " + incident.object_class + " OLS " + std::to_string(incident.target_id);
  event.utime_us = incident.utime_us;
  event.stale_us = stale_us(incident.utime_us, settings.stale_s);
  event.point = incident.place;
  event.geopoint_source = "CALC";
  event.detail = incident_detail(incident, event.callsign, settings);
  return event;
}

CotEvent cot_event(const Line& line, const CotSettings& settings) {
  CotEvent event;
  event.type = "u-rb-a";
  event.uid = line.uid;
  event.how = "m-r";  // by a machine, from a sensor
  event.callsign = line.station + " sees";
  event.utime_us = line.utime_us;
  event.stale_us = stale_us(line.utime_us, settings.stale_s);
  event.point = line.camera;
  event.geopoint_source = "CALC";
  event.detail = line_detail(line, settings.line_m);
  return event;
}

}  // namespace ols::exports
